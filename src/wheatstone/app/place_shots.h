#pragma once

#include <span>
#include <vector>

#include "wheatstone/app/film_shots.h"
#include "wheatstone/app/shots_file.h"
#include "wheatstone/progress.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone {

/// The shots of those frames of a film that `reading` delivers. Their beginnings are found in the whole film, of which
/// every frame must belong to one shot. Throws Error{bad_input} that names file, shot and line: a shot begins beyond
/// the end of the film or not after the shot before it, the first one not with the first frame, a shot ends
/// elsewhere than before the next one, a dissolve does
/// not end within its shot or has none before it, or a key lies outside its shot or not after the key before it; and as
/// open_film.
std::vector<FilmShot> place_shots(std::span<const WrittenShot> shots, const FilmFiles& film,
                                  const FilmReaderOptions& reading, const Progress& progress = {});

}  // namespace wheatstone
