#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{1} << 31;

[[noreturn]] void refuse(const fs::path& path, std::string_view complaint) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), complaint));
}

/// Lossy pictures keep equal colours equal to within this share of white.
constexpr float grey_tolerance = 0.03f;

void read_grey(const fs::path& path, OIIO::ImageInput& input, std::string_view what, Image<float>& values) {
  std::vector<float> colours(values.pixels().size() * 3);
  if (!input.read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, colours.data())) refuse(path, "is damaged or truncated");
  for (std::size_t i = 0; i < values.pixels().size(); ++i) {
    const auto [least, most] = std::minmax({colours[3 * i], colours[3 * i + 1], colours[3 * i + 2]});
    if (most - least > grey_tolerance * std::max(1.f, std::abs(most)))
      refuse(path, fmt::format("is in colour, expected the grey levels of {}", what));
    values.pixels()[i] = colours[3 * i + 1];
  }
}

}  // namespace

float full_scale(OIIO::TypeDesc type) {
  if (type == OIIO::TypeDesc::UINT8) return 255;
  return type == OIIO::TypeDesc::UINT16 ? 65535.f : 1.f;
}

StoredChannel read_stored_channel(const fs::path& path, std::string_view what, GreyInColours colours) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    OIIO::geterror();
    refuse(path, fmt::format("is not {}, expected PNG, PFM or EXR", what));
  }
  return read_stored_channel(*input, path, what, colours);
}

StoredChannel read_stored_channel(OIIO::ImageInput& input, const fs::path& path, std::string_view what,
                                  GreyInColours colours) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.image_bytes() > most_bytes)
    refuse(path, fmt::format("is {}x{} pixels, which is not a valid size for {}", spec.width, spec.height, what));
  if (spec.nchannels >= 3 && colours == GreyInColours::refused)
    refuse(path, fmt::format("has {} channels, expected one", spec.nchannels));
  StoredChannel stored{Image<float>(spec.width, spec.height), spec.format};
  if (spec.nchannels >= 3) {
    read_grey(path, input, what, stored.values);
  } else if (!input.read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, stored.values.pixels().data())) {
    refuse(path, "is damaged or truncated");
  }
  // OpenImageIO brings integers to 0..1.
  const float full = full_scale(spec.format);
  if (full > 1)
    for (float& value : stored.values.pixels()) value = std::round(value * full);
  return stored;
}

}  // namespace wheatstone
