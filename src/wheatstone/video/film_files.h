#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

/// The files of a film of one or two eyes: one film or numbered pictures, or two, an eye each.
struct FilmFiles {
  std::filesystem::path film;   ///< of both eyes, or the left one's
  std::filesystem::path right;  ///< the right eye's; empty: there is no other
  std::optional<StereoLayout> layout;
};

/// Understands a film, numbered pictures as left_%04d.png, two of these with a comma between, an eye each, or a folder.
/// In a folder left_… and right_… with numbers are the eyes; otherwise its numbered pictures must be of one name.
/// Without a layout, films say or let guess theirs, and numbered pictures hold one eye. Throws Error{bad_input} where a
/// folder has no film.
FilmFiles find_film(const std::string& argument, std::optional<StereoLayout> layout = {});

/// Throws as open_stereo_film and open_eye_films.
StereoFilmReader open_film(const FilmFiles& film, const FilmReaderOptions& options = {});

/// Whether a name is that of a film or of numbered pictures, by its ending.
bool is_film(const std::filesystem::path& path);

}  // namespace wheatstone
