#pragma once

#include <filesystem>

#include "wheatstone/app/rotoscope.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone {

/// Whether numbered pictures are OpenEXR of two views in which a renderer has noted the depth of each.
bool is_rendered_film(const std::filesystem::path& pattern);

/// Gives the geometry of the frames of such a film: of each, how depth becomes disparity is found in its pictures
/// (matching/depth_fit.h). With motion in the files, and if every frame is read and painted (`has_motion`), the flow of
/// the left view, too; it is unknown across a cut. A frame that shows nothing has the cameras of the nearest one before
/// it that does; where no depth is known, all is infinitely far. Frames count from 0 among those that `reading`
/// delivers, and may be asked for in any order, with the same results. Throws Error{bad_input} that names the file: as
/// read_rendered_passes, and where the depths of the two views contradict each other.
KnownFrames known_of_rendered_film(const std::filesystem::path& pattern, const FilmReaderOptions& reading,
                                   bool has_motion = true);

}  // namespace wheatstone
