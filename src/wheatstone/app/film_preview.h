#pragma once

#include <cstdint>
#include <filesystem>

#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/progress.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone {

/// What is known of a painted film before it is painted.
struct FilmPreview {
  std::int64_t shots = 0;
  std::int64_t frames = 0;
  double seconds = 0;  ///< that the film takes here, about
  double bytes = 0;    ///< of the film without its sound, about
};

/// Paints five frames of each shot at a third of their width and height, as if the shot began with them, and writes
/// them to one sheet, a row a shot. The first frames of the longest shot are painted and encoded as `output` would be:
/// they tell how many bytes the film takes, and how much longer a whole frame takes than a third of its size. There
/// must be `options.shots`, without a flow that is known. Throws Error{wrong_usage} where the name of the sheet is not
/// that of a picture, and as open_film, rotoscope_frame and FilmWriter. Leaves nothing but the sheet.
FilmPreview preview_film(const FilmFiles& film, const std::filesystem::path& output, const std::filesystem::path& sheet,
                         const RotoscopeFilmOptions& options, const Progress& progress = {});

}  // namespace wheatstone
