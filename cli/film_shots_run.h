#pragma once

#include <string>
#include <vector>

#include "commands.h"
#include "options.h"
#include "report.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {

/// A shots file, which is written or read, and a sheet that shows the shots.
struct ShotsArguments {
  std::string list, file, preview;
};

/// --list-shots, --shots, which is refused where one of `unless` holds, and --preview, where one of `no_preview` does.
Rows shots_rows(ShotsArguments& arguments, const Reasons& unless, const Reasons& no_preview);

/// The rows of the command, of which those are refused with --list-shots that have no effect there: it only looks at
/// the film.
Rows refused_on_list(Rows rows, const ShotsArguments& arguments);

/// A run whose film cannot have all that a shots file may set.
struct LimitedFilm {
  bool of_marks = false, of_one_eye = false;
};

/// The shots of the film, as the shots file has them.
std::vector<FilmShot> shots_from(const ShotsArguments& arguments, const FilmFiles& film,
                                 const RotoscopeFilmOptions& options, LimitedFilm limited, const Session& session);

/// The shots from cut to cut, painted alike. Processes of mpirun share the looking.
std::vector<FilmShot> shots_found(const FilmFiles& film, const RotoscopeFilmOptions& options, const Session& session);

/// Writes a shots file of a film.
Report run_list(const ShotsArguments& arguments, const FilmFiles& film, const FilmReaderOptions& reading,
                const Session& session);

/// Writes a sheet that shows how the shots of `options` will look, and tells what the film will take.
Report run_preview(const ShotsArguments& arguments, const FilmFiles& film, const std::string& output,
                   const RotoscopeFilmOptions& options, const Session& session);

}  // namespace wheatstone::cli
