#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// For each pixel of a picture which pixel of its copy of half the size, of the one there and the eight around it, has
/// the colour most like its own; as an index 0..8, row by row. Both are 8-bit RGB.
Image<std::uint8_t> most_alike_neighbours(const cv::Mat& copy, const cv::Mat& picture);

/// The disparity of a copy of half the size at this one's: each pixel takes that of the copy's pixel that is most
/// alike, so that depth edges follow the picture's.
Image<float> enlarged(const Image<float>& of_copy, const Image<std::uint8_t>& alike);

}  // namespace wheatstone
