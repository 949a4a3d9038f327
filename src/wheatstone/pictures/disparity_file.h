#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads disparities in pixels: PNG (8 or 16 bit, value / scale; 0 is unknown), PFM of either byte order, EXR (one
/// channel). Without a scale a PNG is read as its text says (write_disparity), else with 16 bits as KITTI's value / 256
/// and with 8 as value / 1. Infinities and NaN, Middlebury's and the file's own invalid values become NaN.
/// Throws Error{bad_input} where the file is missing, damaged, holds no disparity, or only unknown ones.
Image<float> read_disparity(const std::filesystem::path& path, std::optional<float> scale = {});

/// Writes disparities by the file name's ending: .pfm and .exr as they are (NaN is unknown), .png as 16-bit
/// value · 256 with 0 for unknown, as KITTI has them, or where they do not fit so, with another scale and an offset.
/// Its text says which: "Disparity scale" and "Disparity offset", for value / scale + offset. Written under a temporary
/// name first, as write_image.
void write_disparity(const std::filesystem::path& path, ImageView<const float> disparity);

/// Reads a picture of depth: the numbers as they are stored, whatever they stand for; NaN where they are not finite.
/// PNG and other pictures of 8 or 16 bits (grey, or colours that are equal), PFM of either byte order, EXR.
/// Throws Error{bad_input} where the file is missing, damaged, in colour, or holds no finite number.
Image<float> read_depth(const std::filesystem::path& path);

/// The same of a PNG or JPEG in memory, brought to 0..1 of what its bits hold; `path` stands for it in messages.
Image<float> decode_depth(std::string_view bytes, const std::filesystem::path& path);

}  // namespace wheatstone
