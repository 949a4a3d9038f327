#pragma once

#include <cstdint>
#include <filesystem>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// How finely each place of a photograph is painted (View::detail): faces that look at the camera more than the rest,
/// small ones most. Empty where there is none, or Debian's opencv-data is not installed.
Image<std::uint8_t> detail_of_faces(ImageView<const Rgb8> photograph);

/// The mean of a picture's three colours. Throws as read_image does.
Image<std::uint8_t> read_detail_map(const std::filesystem::path& file);

/// Throws Error{wrong_usage} for a style that no detail map steers: whose strokes are not fitted, or not propagated.
void check_reads_detail(const Style& style);

/// A map of any size that is stretched over a picture of this size.
Image<std::uint8_t> stretched(ImageView<const std::uint8_t> map, int width, int height);

}  // namespace wheatstone
