#include "wheatstone/pictures/depth_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "wheatstone/image/known_values.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/png_reader_internal.h"
#include "wheatstone/pictures/portable_float_map_internal.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view what = "a depth map";

}  // namespace

Image<float> decode_depth(std::string_view bytes, const fs::path& path) {
  if (!is_png(bytes) && !is_jpeg(bytes)) refuse_damaged(path, "its depth map is neither PNG nor JPEG");
  StoredChannel stored = read_stored_channel(bytes, path, what, GreyInColours::accepted);
  const float full = full_scale(stored.kind);
  for (float& value : stored.values.pixels()) value /= full;
  return std::move(stored.values);
}

Image<float> read_depth(const fs::path& path) {
  const std::string bytes = read_picture_bytes(path);
  const bool is_pfm = bytes.starts_with("Pf") || bytes.starts_with("PF");
  Image<float> depth = is_pfm ? decode_pfm(bytes, path.string())
                              : read_stored_channel(bytes, path, what, GreyInColours::accepted).values;
  for (float& value : depth.pixels())
    if (!std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
  check_known_anywhere(depth, path.string() + ": the depth");
  return depth;
}

}  // namespace wheatstone
