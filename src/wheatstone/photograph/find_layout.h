#pragma once

#include <filesystem>
#include <optional>

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

/// Whether a file's ending says that it holds both views: .mpo, .jps, .pns.
bool is_stereo_file_name(const std::filesystem::path& path);

/// What the last words of a file's name say, as in "tree_sbs.jpg", "tree_LRF_Full_SBS.png", "tree-half-ou.jpg"; none
/// where they say nothing. Whether the halves are squeezed is decided by `width` and `height` where the name does not
/// tell: "LR" means squeezed to some players and full size to others.
std::optional<StereoLayout> layout_from_name(const std::filesystem::path& path, int width, int height);

/// Whether a picture's halves, next to or above each other, are two views of one scene; none where neither pair looks
/// like one. A small copy, as decode_small_jpeg gives it, shows it as well.
std::optional<Arrangement> arrangement_of_halves(ImageView<const Rgb8> picture);

/// What the picture itself shows: halves next to or above each other that are two views of one scene. The left eye's is
/// taken to be the first unless the picture speaks against it (eye_order).
std::optional<StereoLayout> layout_from_halves(ImageView<const Rgb8> picture);

/// Whether halves of a picture of this size are more likely squeezed: full-size views are seldom wider than 2.4 : 1 and
/// a squeezed side-by-side picture has the shape of a film, 16 : 9.
bool looks_half_size(bool side_by_side, int width, int height);

}  // namespace wheatstone
