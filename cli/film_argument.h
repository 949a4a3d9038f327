#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/video/stereo_film.h"

namespace wheatstone::cli {

/// What a film argument names: one film or numbered pictures, or two, an eye each.
struct FilmArgument {
  std::filesystem::path film;   ///< of both eyes, or the left one's
  std::filesystem::path right;  ///< the right eye's; empty: there is no other
  std::optional<StereoLayout> layout;
};

/// Understands a film, numbered pictures as left_%04d.png, two of these with a comma between, an eye each, or a folder.
/// In a folder left_… and right_… with numbers are the eyes; otherwise its numbered pictures must be of one name.
/// Without a layout, films say or let guess theirs, and numbered pictures hold one eye. Throws Error{bad_input} where a
/// folder has no film.
FilmArgument find_film(const std::string& argument, std::optional<StereoLayout> layout);

/// Throws as open_stereo_film and open_eye_films.
StereoFilmReader open_film(const FilmArgument& film, const FilmReaderOptions& options = {});

/// The layout of a --layout option; nothing where it is empty. Throws Error{wrong_usage} that lists the names.
std::optional<StereoLayout> film_layout_option(const std::string& option, const std::string& name);

}  // namespace wheatstone::cli
