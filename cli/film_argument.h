#pragma once

#include <optional>
#include <string>

#include "wheatstone/video/stereo_film.h"

namespace wheatstone::cli {

/// Opens what a film argument names: a film, numbered pictures as left_%04d.png, two of these with a comma between, an
/// eye each, or a folder. In a folder left_… and right_… with numbers are the eyes; otherwise its numbered pictures
/// must be of one name. Without a layout, films say or let guess theirs, and numbered pictures hold one eye. Throws
/// Error{bad_input} where there is no film, as open_stereo_film, and wrong_usage.
StereoFilmReader open_film_argument(const std::string& argument, std::optional<FilmLayout> layout);

}  // namespace wheatstone::cli
