#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "options.h"
#include "report.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::cli {

/// What `pack` has only for films.
struct PackFilmArguments {
  std::vector<std::string> files;
  std::string layout;  ///< of a film that holds both eyes; empty: as it says, or else guessed
  std::string to, output;
  bool swap = false;
  float shift_px = 0;
  FilmWriterOptions writing;
};

/// Whether the input is a film, or one for each eye, or a folder of numbered pictures that are to become a film.
bool are_films(const std::vector<std::string>& files, const std::string& output);

/// How the film is coded, what is copied and --projection. `writes_no_film` is for how it is coded: other films are
/// written, too.
Rows pack_film_rows(FilmWriterOptions& writing, const Reason& no_film, const Reason& writes_no_film);

/// Writes a film in another stereo layout.
Report run_pack_film(PackFilmArguments arguments, const Session& session);

}  // namespace wheatstone::cli
