#include "wheatstone/pictures/disparity_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/known_values.h"
#include "wheatstone/pictures/encoders_internal.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/png_chunks.h"
#include "wheatstone/pictures/png_reader_internal.h"
#include "wheatstone/pictures/portable_float_map_internal.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

constexpr float kitti_scale = 256;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
/// Disparities beyond this are somebody's way of saying unknown.
constexpr float largest_disparity_px = 65535;

/// How a PNG stores disparities in pixels: value / scale + offset.
struct Steps {
  float scale = kitti_scale, offset = 0;
};

void invalidate(Image<float>& disparity, Steps steps, bool zero_is_unknown) {
  for (float& value : disparity.pixels()) {
    const bool known = std::isfinite(value) && !(zero_is_unknown && value == 0);
    value = known ? value / steps.scale + steps.offset : unknown;
    if (std::abs(value) > largest_disparity_px) value = unknown;
  }
}

void check_scale(const std::filesystem::path& path, std::optional<float> scale) {
  if (scale && !(std::isfinite(*scale) && *scale > 0))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: the scale is {}, expected a number above 0", path.string(), *scale));
}

/// As KITTI has them where all fit; else as fine as all fit.
Steps steps_for(ImageView<const float> disparity) {
  constexpr float most_steps = 65534;  // 0 is for what is unknown
  const auto [least, largest] = range_with_zero(disparity);
  if (least >= 0 && largest * kitti_scale <= most_steps) return {};
  const float offset = std::floor(least) - 1;
  return {std::min(most_steps / (largest - offset), kitti_scale), offset};
}

// The names of what a PNG's text says of its steps (PNG 1.2, sec. 4.2.3.1).
constexpr std::string_view scale_key = "Disparity scale", offset_key = "Disparity offset";

void write_png(const std::filesystem::path& path, ImageView<const float> disparity) {
  const Steps steps = steps_for(disparity);
  Image<std::uint16_t> values(disparity.width(), disparity.height());
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    // A known 0 is written as the smallest step: 0 itself means unknown.
    std::ranges::transform(disparity.row(y), values.row(y).begin(), [&](float d) {
      return static_cast<std::uint16_t>(std::isfinite(d) ? std::max(std::lround((d - steps.offset) * steps.scale), 1L)
                                                         : 0);
    });
  });
  StoredPicture picture{disparity.width(), disparity.height(), 1};
  picture.kind = words_kind;
  picture.put(std::string(png_text) + std::string(scale_key), fmt::format("{}", steps.scale));
  picture.put(std::string(png_text) + std::string(offset_key), fmt::format("{}", steps.offset));
  const PixelRows rows{values.pixels().data(), words_kind, 0, picture.height, std::ptrdiff_t{2} * picture.width};
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

/// A number of a text; `otherwise` where it is none.
float number_of(std::string_view text, float otherwise) {
  float number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number) ? number : otherwise;
}

/// What a PNG's text says of its values, else as usual.
Steps steps_said_by(std::string_view bytes, float usual_scale) {
  Steps steps{usual_scale, 0};
  const auto chunks = is_png(bytes) ? png_chunks(bytes) : std::nullopt;
  if (!chunks) return steps;
  for (const PngChunk& chunk : *chunks) {
    const std::size_t end = chunk.data.find('\0');
    if (chunk.type != "tEXt" || end == std::string_view::npos) continue;
    const std::string_view key = chunk.data.substr(0, end), text = chunk.data.substr(end + 1);
    if (key == scale_key) steps.scale = number_of(text, usual_scale);
    if (key == offset_key) steps.offset = number_of(text, 0);
  }
  if (steps.scale <= 0) steps.scale = usual_scale;
  return steps;
}

Image<float> read_any_disparity(const std::filesystem::path& path, std::optional<float> scale) {
  const std::string bytes = read_whole_file(path, most_picture_bytes);
  if (bytes.starts_with("Pf") || bytes.starts_with("PF")) {
    Image<float> disparity = decode_pfm(bytes, path.string());
    invalidate(disparity, {scale.value_or(1), 0}, false);
    return disparity;
  }
  StoredChannel stored = read_stored_channel(bytes, path, "a disparity map", GreyInColours::refused);
  const bool integer = stored.kind == bytes_kind || stored.kind == words_kind;
  const Steps said = steps_said_by(bytes, stored.kind == words_kind ? kitti_scale : 1.f);
  invalidate(stored.values, scale ? Steps{*scale, 0} : said, integer);
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
  if (kind == ".pfm") return write_pfm(path, disparity);
  if (kind == ".png") return write_png(path, disparity);
  if (kind == ".exr") return write_exr(path, disparity);
  throw Error(
      ErrorKind::wrong_usage,
      fmt::format("{}: there is no disparity format for '{}', expected .pfm, .png or .exr", path.string(), kind));
}

namespace {

namespace fs = std::filesystem;

constexpr std::string_view what_is_read = "a depth map";

}  // namespace

Image<float> decode_depth(std::string_view bytes, const fs::path& path) {
  if (!is_png(bytes) && !is_jpeg(bytes)) refuse_damaged(path, "its depth map is neither PNG nor JPEG");
  StoredChannel stored = read_stored_channel(bytes, path, what_is_read, GreyInColours::accepted);
  const float full = full_scale(stored.kind);
  for (float& value : stored.values.pixels()) value /= full;
  return std::move(stored.values);
}

Image<float> read_depth(const fs::path& path) {
  const std::string bytes = read_picture_bytes(path);
  const bool is_pfm = bytes.starts_with("Pf") || bytes.starts_with("PF");
  Image<float> depth = is_pfm ? decode_pfm(bytes, path.string())
                              : read_stored_channel(bytes, path, what_is_read, GreyInColours::accepted).values;
  for (float& value : depth.pixels())
    if (!std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
  check_known_anywhere(depth, path.string() + ": the depth");
  return depth;
}

}  // namespace wheatstone
