#pragma once

#include <string>

#include "command.h"
#include "options.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {

/// Where a film is painted, as it is typed.
struct MaskArguments {
  std::string file;              ///< empty: everywhere
  std::string outside = "none";  ///< or a style
};

inline constexpr auto keeps_depth_in_masks = "with --mask; the film keeps its depth";

/// --mask, which is refused where one of `unless` holds, and --outside.
Rows mask_rows(MaskArguments& arguments, const Reasons& unless);

/// Masks of the film that `source` reads, and what is shown outside. Throws Error as mask_of_film and read_style.
void take_mask(const MaskArguments& arguments, const FilmFiles& film, const StereoFilmReader& source,
               const Session& session, RotoscopeFilmOptions& options);

}  // namespace wheatstone::cli
