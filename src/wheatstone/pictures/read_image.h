#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads a photograph as 8-bit sRGB: grey becomes three equal channels, 16-bit and float are rounded, CMYK is
/// converted, alpha is composited over white, an ICC profile is brought to sRGB, EXIF orientation is applied. A profile
/// that is damaged or does not fit the picture is left aside, as viewers do.
/// Throws Error{bad_input} where the file is missing, is no picture, or is truncated.
Image<Rgb8> read_image(const std::filesystem::path& path);
/// The same with 16 bits a channel; empty where the file has 8 or fewer.
Image<Rgb16> read_deep_image(const std::filesystem::path& path);

/// Two pictures, which are read at once. Throws as read_image, for the first of them where both cannot be read.
std::array<Image<Rgb8>, 2> read_two_images(const std::filesystem::path& first, const std::filesystem::path& second);

/// The same of a JPEG in memory; `path` stands for it in messages.
Image<Rgb8> decode_jpeg(std::string_view bytes, const std::filesystem::path& path);
/// The same of a file's only JPEG, decoded fast for a first look: the smallest of an eighth, a quarter and a half of
/// its size that is at least 300 pixels wide and high; where none is, the whole picture.
Image<Rgb8> decode_small_jpeg(std::string_view bytes, const std::filesystem::path& path);

/// A picture in the colours of its file.
struct PictureInProfile {
  Image<Rgb8> picture;
  std::string colour_profile;  ///< ICC, of three channels, as the file has it; empty: sRGB
};

/// As read_image, read_two_images and decode_jpeg, but for the colours.
PictureInProfile read_in_profile(const std::filesystem::path& path);
std::array<PictureInProfile, 2> read_two_in_profile(const std::filesystem::path& first,
                                                    const std::filesystem::path& second);
PictureInProfile decode_jpeg_in_profile(std::string_view bytes, const std::filesystem::path& path);

/// Brings pictures to sRGB, except with `keep_shared` where all have the same profile, of other colours than sRGB's,
/// and of a size that every format takes: then they stay as they are, and it is returned; else nothing is.
std::string bring_to_one_profile(std::span<PictureInProfile> pictures, bool keep_shared);

/// Whether these are the bytes of a GIF, an animated WebP or an animated PNG, which hold one frame or more.
bool may_be_animated(std::string_view bytes);

/// The frames of such a picture as they are shown, but at most `most_frames`. Throws Error as read_image, also where a
/// frame of a PNG is only a part of the picture.
std::vector<Image<Rgb8>> read_picture_frames(const std::filesystem::path& path, int most_frames);

/// What a picture file says of itself, before anything is converted.
struct ImageDescription {
  std::string format;  ///< "png", "jpeg", "tiff" and so on
  int width = 0;       ///< as stored, before its orientation is applied
  int height = 0;
  int channels = 0;
  bool has_alpha = false;
  int bits = 8;  ///< of each channel
  bool is_float = false;
  int orientation = 1;  ///< EXIF: 1 is upright
};

/// Reads a picture's header. Throws Error as read_image; damage behind the header may go unseen.
ImageDescription describe_image(const std::filesystem::path& path);

}  // namespace wheatstone
