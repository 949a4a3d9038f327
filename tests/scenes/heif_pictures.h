#pragma once

// HEIC files for tests.

#include <libheif/heif.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

struct PlainPicture {
  Rgb8 colour;
  int width = 64, height = 64;
  std::string colour_profile = {};
  std::uint16_t primaries = 0;  ///< by their number in ISO/IEC 23091-2; 0: not told
};

/// Encodes pictures into one HEIC file; false where no encoder is installed. `make(i)` makes each of `count`.
template <class Make>
bool write_heic(const std::filesystem::path& path, std::size_t count, Make make) {
  heif_context* context = heif_context_alloc();
  heif_encoder* encoder = nullptr;
  if (heif_context_get_encoder_for_format(context, heif_compression_HEVC, &encoder).code != heif_error_Ok) {
    heif_context_free(context);
    return false;
  }
  heif_encoder_set_lossy_quality(encoder, 95);
  heif_encoding_options* options = heif_encoding_options_alloc();
  options->macOS_compatibility_workaround_no_nclx_profile = 0;  // else numbers that tell the colours are not written
  for (std::size_t i = 0; i < count; ++i) {
    heif_image* image = make(i);
    heif_image_handle* handle = nullptr;
    heif_context_encode_image(context, image, encoder, options, &handle);
    heif_image_handle_release(handle);
    heif_image_release(image);
  }
  heif_encoding_options_free(options);
  heif_encoder_release(encoder);
  heif_context_write_to_file(context, path.c_str());
  heif_context_free(context);
  return true;
}

/// A picture in memory for write_heic. `fill(y, row)` writes the bytes of each row.
template <class Fill>
heif_image* make_heif_image(int width, int height, heif_chroma chroma, Fill fill) {
  heif_image* image = nullptr;
  heif_image_create(width, height, heif_colorspace_RGB, chroma, &image);
  heif_image_add_plane(image, heif_channel_interleaved, width, height, 8);
  int stride = 0;
  std::uint8_t* plane = heif_image_get_plane(image, heif_channel_interleaved, &stride);
  for (int y = 0; y < height; ++y) fill(y, plane + static_cast<std::ptrdiff_t>(y) * stride);
  return image;
}

/// Writes plain pictures into one HEIC file; false where no encoder is installed.
inline bool put_heic(const std::filesystem::path& path, const std::vector<PlainPicture>& pictures) {
  return write_heic(path, pictures.size(), [&](std::size_t i) {
    const PlainPicture& plain = pictures[i];
    heif_image* image = make_heif_image(
        plain.width, plain.height, heif_chroma_interleaved_RGB,
        [&](int, std::uint8_t* row) { std::fill_n(reinterpret_cast<Rgb8*>(row), plain.width, plain.colour); });
    const std::string& profile = plain.colour_profile;
    if (!profile.empty()) heif_image_set_raw_color_profile(image, "prof", profile.data(), profile.size());
    if (plain.primaries != 0) {
      heif_color_profile_nclx* colours = heif_nclx_color_profile_alloc();
      heif_nclx_color_profile_set_color_primaries(colours, plain.primaries);
      heif_image_set_nclx_color_profile(image, colours);
      heif_nclx_color_profile_free(colours);
    }
    return image;
  });
}

}  // namespace wheatstone
