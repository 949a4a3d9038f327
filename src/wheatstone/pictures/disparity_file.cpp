#include "wheatstone/pictures/disparity_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/portable_float_map.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 31;
constexpr float kitti_scale = 256;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
/// Disparities beyond this are somebody's way of saying unknown.
constexpr float largest_disparity_px = 65535;

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view complaint) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), complaint));
}

std::string ending(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
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

/// Encoded in memory and written by us: the encoders do not all notice that a disk is full.
void write_encoded(const std::filesystem::path& path, const OIIO::ImageSpec& spec, const void* pixels,
                   OIIO::stride_t row_bytes) {
  const std::string name = "disparity" + ending(path);
  const auto encoder = OIIO::ImageOutput::create(name);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const bool encoded = encoder && encoder->set_ioproxy(&memory) && encoder->open(name, spec) &&
                       encoder->write_image(spec.format, pixels, OIIO::AutoStride, row_bytes) && encoder->close();
  if (!encoded)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot write: {}", path.string(), encoder ? encoder->geterror() : OIIO::geterror()));
  write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void write_png(const std::filesystem::path& path, ImageView<const float> disparity) {
  std::vector<std::uint16_t> values;
  for (int y = 0; y < disparity.height(); ++y) {
    for (const float d : disparity.row(y)) {
      if (std::isfinite(d) && (d < 0 || d * kitti_scale > 65535))
        refuse(path, fmt::format("a disparity of {} does not fit a 16-bit PNG, expected 0 to 255; write .pfm", d));
      // A known 0 is written as the smallest step: 0 itself means unknown.
      values.push_back(std::isfinite(d) ? static_cast<std::uint16_t>(std::max(std::lround(d * kitti_scale), 1L)) : 0);
    }
  }
  const OIIO::ImageSpec spec(disparity.width(), disparity.height(), 1, OIIO::TypeDesc::UINT16);
  write_encoded(path, spec, values.data(), OIIO::AutoStride);
}

void write_exr(const std::filesystem::path& path, ImageView<const float> disparity) {
  OIIO::ImageSpec spec(disparity.width(), disparity.height(), 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"disparity"};
  // Otherwise the time of writing: the same disparity is to be the same bytes.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  write_encoded(path, spec, disparity.data(),
                static_cast<OIIO::stride_t>(disparity.stride() * static_cast<std::ptrdiff_t>(sizeof(float))));
}

}  // namespace

Image<float> read_disparity(const std::filesystem::path& path, std::optional<float> scale) {
  check_scale(path, scale);
  const std::string bytes = read_whole_file(path, most_bytes);
  if (bytes.starts_with("Pf") || bytes.starts_with("PF")) {
    Image<float> disparity = decode_pfm(bytes, path.string());
    invalidate(disparity, scale.value_or(1), false);
    return disparity;
  }
  StoredChannel stored = read_stored_channel(path, "a disparity map", GreyInColours::refused);
  const bool integer = stored.type == OIIO::TypeDesc::UINT8 || stored.type == OIIO::TypeDesc::UINT16;
  const float usual_scale = stored.type == OIIO::TypeDesc::UINT16 ? kitti_scale : 1.f;
  invalidate(stored.values, scale.value_or(usual_scale), integer);
  return std::move(stored.values);
}

void write_disparity(const std::filesystem::path& path, ImageView<const float> disparity) {
  const std::string kind = ending(path);
  if (kind == ".pfm") return write_whole_file(path, encode_pfm(disparity));
  if (kind == ".png") return write_png(path, disparity);
  if (kind == ".exr") return write_exr(path, disparity);
  throw Error(
      ErrorKind::wrong_usage,
      fmt::format("{}: there is no disparity format for '{}', expected .pfm, .png or .exr", path.string(), kind));
}

}  // namespace wheatstone
