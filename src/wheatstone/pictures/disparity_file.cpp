#include "wheatstone/pictures/disparity_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/known_values.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/portable_float_map.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 31;
constexpr float kitti_scale = 256;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
/// Disparities beyond this are somebody's way of saying unknown.
constexpr float largest_disparity_px = 65535;

[[noreturn]] void refuse_disparity(const std::filesystem::path& path, std::string_view complaint) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), complaint));
}

void invalidate(Image<float>& disparity, float scale, bool zero_is_unknown) {
  for (float& value : disparity.pixels()) {
    const bool known = std::isfinite(value) && !(zero_is_unknown && value == 0);
    value = known ? value / scale : unknown;
    if (std::abs(value) > largest_disparity_px) value = unknown;
  }
}

void check_scale(const std::filesystem::path& path, std::optional<float> scale) {
  if (scale && !(std::isfinite(*scale) && *scale > 0))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: the scale is {}, expected a number above 0", path.string(), *scale));
}

void write_png(const std::filesystem::path& path, ImageView<const float> disparity) {
  std::vector<std::uint16_t> values;
  for (int y = 0; y < disparity.height(); ++y) {
    for (const float d : disparity.row(y)) {
      if (std::isfinite(d) && (d < 0 || d * kitti_scale > 65535))
        refuse_disparity(path,
                         fmt::format("a disparity of {} does not fit a 16-bit PNG, expected 0 to 255; write .pfm", d));
      // A known 0 is written as the smallest step: 0 itself means unknown.
      values.push_back(std::isfinite(d) ? static_cast<std::uint16_t>(std::max(std::lround(d * kitti_scale), 1L)) : 0);
    }
  }
  StoredPicture picture{disparity.width(), disparity.height(), 1};
  picture.kind = words_kind;
  const PixelRows rows{values.data(), words_kind, 0, picture.height, picture.width * 2};
  write_whole_file(path, encode_picture(path, picture, rows));
}

void write_exr(const std::filesystem::path& path, ImageView<const float> disparity) {
  StoredPicture picture{disparity.width(), disparity.height(), 1};
  picture.kind = floats_kind;
  picture.channel_names = {"disparity"};
  // Otherwise the time of writing: the same disparity is to be the same bytes.
  picture.put("DateTime", "1970:01:01 00:00:00");
  write_whole_file(path, encode_picture(path, picture, rows_of(disparity)));
}

Image<float> read_any_disparity(const std::filesystem::path& path, std::optional<float> scale) {
  const std::string bytes = read_whole_file(path, most_bytes);
  if (bytes.starts_with("Pf") || bytes.starts_with("PF")) {
    Image<float> disparity = decode_pfm(bytes, path.string());
    invalidate(disparity, scale.value_or(1), false);
    return disparity;
  }
  StoredChannel stored = read_stored_channel(bytes, path, "a disparity map", GreyInColours::refused);
  const bool integer = stored.kind == bytes_kind || stored.kind == words_kind;
  const float usual_scale = stored.kind == words_kind ? kitti_scale : 1.f;
  invalidate(stored.values, scale.value_or(usual_scale), integer);
  return std::move(stored.values);
}

}  // namespace

Image<float> read_disparity(const std::filesystem::path& path, std::optional<float> scale) {
  check_scale(path, scale);
  Image<float> disparity = read_any_disparity(path, scale);
  check_known_anywhere(disparity, path.string() + ": the disparity");
  return disparity;
}

void write_disparity(const std::filesystem::path& path, ImageView<const float> disparity) {
  const std::string kind = ending_of(path);
  if (kind == ".pfm") return write_whole_file(path, encode_pfm(disparity));
  if (kind == ".png") return write_png(path, disparity);
  if (kind == ".exr") return write_exr(path, disparity);
  throw Error(
      ErrorKind::wrong_usage,
      fmt::format("{}: there is no disparity format for '{}', expected .pfm, .png or .exr", path.string(), kind));
}

}  // namespace wheatstone
