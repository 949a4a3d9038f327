#include <fmt/format.h>
#include <webp/encode.h>

#include <memory>

#include "wheatstone/pictures/encoders_internal.h"

namespace wheatstone {

EncodedPicture encode_webp(const StoredPicture& picture, const PixelRows& rows) {
  if (picture.width > WEBP_MAX_DIMENSION || picture.height > WEBP_MAX_DIMENSION)
    return {{}, fmt::format("a WebP has at most {} pixels a side", WEBP_MAX_DIMENSION)};
  WebPConfig config;
  WebPPicture encoded;
  if (WebPConfigPreset(&config, WEBP_PRESET_PHOTO, 100) == 0 || WebPPictureInit(&encoded) == 0)
    return {{}, "the installed libwebp does not fit this program"};
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> held(&encoded, WebPPictureFree);
  WebPMemoryWriter memory;
  WebPMemoryWriterInit(&memory);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> held_memory(&memory, WebPMemoryWriterClear);
  encoded.width = picture.width;
  encoded.height = picture.height;
  encoded.writer = WebPMemoryWrite;
  encoded.custom_ptr = &memory;
  if (WebPPictureImportRGB(&encoded, static_cast<const std::uint8_t*>(rows.first), static_cast<int>(rows.row_bytes)) ==
          0 ||
      WebPEncode(&config, &encoded) == 0)
    return {{}, fmt::format("libwebp fails with error {}", static_cast<int>(encoded.error_code))};
  return {{reinterpret_cast<const char*>(memory.mem), memory.size}, {}};
}

}  // namespace wheatstone
