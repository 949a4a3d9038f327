#pragma once

#include <string>
#include <string_view>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// Attributes whose names begin so become texts of the PNG, by the rest of their names.
inline constexpr std::string_view png_text = "png:text:";

/// A picture of one channel, grey, or three, with bytes or words, as a PNG (PNG 1.2). Its colours are said to be sRGB
/// where the attribute oiio:ColorSpace says so. Made in parallel; the same bytes on any number of threads.
std::string encode_png(const StoredPicture& picture, const PixelRows& rows);

/// A picture of one channel, grey, or three, with bytes or words, as a TIFF, deflated. Takes the attributes
/// ImageDescription, DateTime, ICCProfile, and XResolution in pixels an inch.
EncodedPicture encode_tiff(const StoredPicture& picture, const PixelRows& rows);

/// A picture of three channels with bytes as a WebP of the best quality that loses something; its sides have at most
/// 16 383 pixels.
EncodedPicture encode_webp(const StoredPicture& picture, const PixelRows& rows);

}  // namespace wheatstone
