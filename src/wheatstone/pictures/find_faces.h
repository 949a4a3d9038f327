#pragma once

#include <optional>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A rectangle of pixels: columns left to left + width − 1, rows top to top + height − 1.
struct PixelBox {
  int left = 0, top = 0;
  int width = 0, height = 0;
};

/// Faces that look at the camera, as OpenCV's frontal cascade finds them (Viola & Jones 2001) in a copy of the picture
/// of this width, where they are 40 pixels wide or more. Nothing where Debian's package opencv-data, which
/// holds the cascade, is not installed.
std::optional<std::vector<PixelBox>> find_faces(ImageView<const Rgb8> picture, int searched_width_px = 1200);

}  // namespace wheatstone
