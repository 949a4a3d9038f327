#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command.h"
#include "paint_arguments.h"
#include "wheatstone/photograph/find_photographs.h"

namespace wheatstone::cli {

/// The photographs of one run, and the files that it leaves out.
struct PaintList {
  std::vector<PaintJob> jobs;
  std::vector<LeftOutFile> left_out = {};
};

/// The photographs in the folder that is given, each with a folder in the output. Throws Error: bad_input, or
/// wrong_usage where results would lie in the folder itself.
PaintList photographs_in_folder(const PaintArguments& arguments, const Session& session);

/// What is told of a photograph that was painted, and where that was written.
struct Painted {
  Report report;
  std::string written;
};
using PaintOne = std::function<Painted(const PaintJob& job, const Session& session)>;

/// Paints each photograph; one that fails does not stop the others. Tells of each, and of each file that is left out.
Report paint_all(const PaintArguments& arguments, const PaintList& list, const PaintOne& paint, const Session& session);

}  // namespace wheatstone::cli
