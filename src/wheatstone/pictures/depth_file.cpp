#include "wheatstone/pictures/depth_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/pictures/jpeg_end_internal.h"
#include "wheatstone/pictures/open_picture_internal.h"
#include "wheatstone/pictures/plain_png_internal.h"
#include "wheatstone/pictures/portable_float_map.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// A PNG or JPEG in memory, whole; none where it is neither.
std::optional<StoredChannel> decoded(std::string_view bytes, const fs::path& path) {
  const bool is_png = bytes.starts_with("\x89PNG\r\n\x1a\n");
  if (!is_png && !bytes.starts_with("\xFF\xD8")) return {};
  std::string plain;
  if (is_png) {
    std::optional<std::string> whole = plain_png(bytes);
    if (!whole) refuse_damaged(path, "it ends too early, or its checksums are wrong");
    plain = std::move(*whole);
    bytes = plain;
  } else if (!jpeg_is_whole(bytes)) {
    refuse_damaged(path, "it ends too early");
  }
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
  const auto decoder = OIIO::ImageInput::create(is_png ? "png" : "jpeg");
  OIIO::ImageSpec spec;
  if (!decoder || !decoder->set_ioproxy(&memory) || !decoder->open("", spec))
    refuse_damaged(path, decoder ? decoder->geterror() : OIIO::geterror());
  return read_stored_channel(*decoder, path, "a depth map", GreyInColours::accepted);
}

}  // namespace

Image<float> decode_depth(std::string_view bytes, const fs::path& path) {
  std::optional<StoredChannel> stored = decoded(bytes, path);
  if (!stored) refuse_damaged(path, "its depth map is neither PNG nor JPEG");
  const float full = full_scale(stored->type);
  for (float& value : stored->values.pixels()) value /= full;
  return std::move(stored->values);
}

Image<float> read_depth(const fs::path& path) {
  const std::string bytes = read_picture_bytes(path);
  const bool is_pfm = bytes.starts_with("Pf") || bytes.starts_with("PF");
  std::optional<StoredChannel> stored;
  if (!is_pfm) stored = decoded(bytes, path);
  if (!is_pfm && !stored) stored = read_stored_channel(path, "a depth map", GreyInColours::accepted);
  Image<float> depth = is_pfm ? decode_pfm(bytes, path.string()) : std::move(stored->values);
  bool some_known = false;
  for (float& value : depth.pixels()) {
    if (std::isfinite(value))
      some_known = true;
    else
      value = std::numeric_limits<float>::quiet_NaN();
  }
  if (!some_known)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: the depth is unknown everywhere, expected at least one finite value", path.string()));
  return depth;
}

}  // namespace wheatstone
