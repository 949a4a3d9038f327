#pragma once

#include <string_view>

namespace wheatstone {

/// The tag Orientation of EXIF data, which begin with a TIFF header; 1, upright, where it is missing or damaged.
/// EXIF 2.3, sec. 4.5 and 4.6.4.
int exif_orientation(std::string_view exif);

}  // namespace wheatstone
