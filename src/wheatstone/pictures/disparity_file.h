#pragma once

#include <filesystem>
#include <optional>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads disparities in pixels: PNG (8 or 16 bit, value / scale; 0 is unknown), PFM of either byte order, EXR (one
/// channel). Without a scale a 16-bit PNG is read as KITTI's value / 256 and an 8-bit one as value / 1. Infinities and
/// NaN, Middlebury's and the file's own invalid values become NaN.
/// Throws Error{bad_input} where the file is missing, damaged, holds no disparity, or only unknown ones.
Image<float> read_disparity(const std::filesystem::path& path, std::optional<float> scale = {});

/// Writes disparities by the file name's ending: .pfm and .exr as they are (NaN is unknown), .png as 16-bit
/// value · 256 with 0 for unknown (KITTI; negative disparities do not fit: Error{bad_input}).
/// Written under a temporary name first, as write_image.
void write_disparity(const std::filesystem::path& path, ImageView<const float> disparity);

}  // namespace wheatstone
