#pragma once

#include <string>

#include "commands.h"
#include "options.h"
#include "report.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {

/// A shots file, which is written or read.
struct ShotsArguments {
  std::string list;
};

/// --list-shots.
Rows shots_rows(ShotsArguments& arguments);

/// The rows of the command, of which those are refused with --list-shots that have no effect there: it only looks at
/// the film.
Rows refused_on_list(Rows rows, const ShotsArguments& arguments);

/// Writes a shots file of a film.
Report run_list(const ShotsArguments& arguments, const FilmFiles& film, const FilmReaderOptions& reading,
                const Session& session);

}  // namespace wheatstone::cli
