#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "photograph_folder.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::cli {

/// What is told of a photograph that was worked on, and where its result was written.
struct PhotographResult {
  Report report;
  std::string written;
};

/// What a command does with each of several photographs.
struct PhotographWork {
  std::string input;   ///< the folder; empty: files were given
  std::string output;  ///< the folder in which all results lie
  FolderArguments folder;
  std::string_view done;  ///< what becomes of a photograph, as "painted"; also the key of their number
  int max_size = 0;       ///< longer side of what is worked on; 0: as large as it is
  std::function<PhotographResult(const PhotographJob&, const Session&)> work;
  std::function<bool(const PhotographJob&)> is_done;  ///< whether the result is there, whole
  /// The picture of a result for the contact sheet; none where there is none.
  std::function<std::optional<std::filesystem::path>(const PhotographJob&)> shown = {};
};

/// Works on each photograph; one that fails does not stop the others. Several are worked on at a time: as many as there
/// are threads, but not more than together take half of the memory that is free when the run begins, of which a
/// photograph counts with 100 bytes for each pixel of its views. One that alone would take more than that is worked on
/// alone, and one that would take more than the machine has is refused. The results are the same as one by one. Tells
/// of each, and of each file that is left out, in their order.
Report work_on_all(const PhotographWork& work, const PhotographList& list, const Session& session);

/// What a command that needs two views does with one photograph, whose result is a folder.
using PairWork = std::function<PhotographResult(const StereoArguments&, const std::string& output, const Session&)>;

/// work_on_all for the pairs in the folder `photographs.left`. `done` as PhotographWork's.
Report work_on_pairs(const StereoArguments& photographs, const FolderArguments& folder, const std::string& output,
                     std::string_view done, const PairWork& work, const Session& session);

/// What a command that needs two views tells: of the photograph that it is given, or of all pairs where a folder is
/// given. Its arguments have `photographs`, `walk`, and the `folder` of the results.
template <class Arguments>
Report work_on_photograph_or_pairs(const Arguments& arguments, std::string_view done,
                                   PhotographResult (*work)(const Arguments&, const Session&), const Session& session) {
  if (!is_folder(arguments.photographs.left)) return work(arguments, session).report;
  const auto work_on_pair = [&](const StereoArguments& photograph, const std::string& output, const Session& of_one) {
    Arguments one = arguments;
    one.photographs = photograph;
    one.folder = output;
    return work(one, of_one);
  };
  return work_on_pairs(arguments.photographs, arguments.walk, arguments.folder, done, work_on_pair, session);
}

}  // namespace wheatstone::cli
