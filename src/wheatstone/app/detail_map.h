#pragma once

#include <cstdint>
#include <filesystem>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// How finely each place of a photograph is painted (View::detail): faces that look at the camera more than the rest,
/// small ones most. Empty where there is none, or Debian's opencv-data is not installed.
Image<std::uint8_t> detail_of_faces(ImageView<const Rgb8> photograph);

/// The mean of a picture's three colours. Throws as read_image does.
Image<std::uint8_t> read_detail_map(const std::filesystem::path& file);

}  // namespace wheatstone
