#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/png_reader_internal.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_channel(const fs::path& path, std::string_view complaint) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), complaint));
}

/// Lossy pictures keep equal colours equal to within this share of white.
constexpr float grey_tolerance = 0.03f;

void read_grey(const fs::path& path, PictureReader& reader, std::string_view what, Image<float>& values) {
  std::vector<float> colours(values.pixels().size() * 3);
  if (!reader.read(0, values.height(), 3, colours.data())) refuse_channel(path, "is damaged or truncated");
  for (std::size_t i = 0; i < values.pixels().size(); ++i) {
    const auto [least, most] = std::minmax({colours[3 * i], colours[3 * i + 1], colours[3 * i + 2]});
    if (most - least > grey_tolerance * std::max(1.f, std::abs(most)))
      refuse_channel(path, fmt::format("is in colour, expected the grey levels of {}", what));
    values.pixels()[i] = colours[3 * i + 1];
  }
}

StoredChannel first_channel(PictureReader& reader, const fs::path& path, std::string_view what, GreyInColours colours) {
  const StoredPicture& picture = reader.picture();
  const auto [width, height] = std::pair(picture.width, picture.height);
  const std::size_t bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(picture.channels * picture.kind.bits / 8);
  if (width < 1 || height < 1 || picture.depth > 1 || bytes > most_picture_bytes)
    refuse_channel(path, fmt::format("is {}x{} pixels, which is not a valid size for {}", width, height, what));
  if (picture.channels >= 3 && colours == GreyInColours::refused)
    refuse_channel(path, fmt::format("is a picture for looking at, with {} channels; expected {} with one channel",
                                     picture.channels, what));
  StoredChannel stored{Image<float>(width, height), picture.kind};
  if (picture.channels >= 3) {
    read_grey(path, reader, what, stored.values);
  } else if (!reader.read(0, height, 1, stored.values.pixels().data())) {
    refuse_channel(path, "is damaged or truncated");
  }
  const float full = full_scale(picture.kind);
  if (full > 1)
    for (float& value : stored.values.pixels()) value = std::round(value * full);
  return stored;
}

}  // namespace

float full_scale(NumberKind kind) {
  if (kind == bytes_kind) return 255;
  return kind == words_kind ? 65535.f : 1.f;
}

StoredChannel read_stored_channel(std::string_view bytes, const fs::path& path, std::string_view what,
                                  GreyInColours colours) {
  OpenedPicture opened;
  std::string plain;
  if (is_png(bytes)) {
    std::optional<std::string> whole = plain_png(bytes);
    if (!whole) refuse_damaged(path, "it ends too early, or its checksums are wrong");
    plain = std::move(*whole);
    opened = open_png_bytes(plain, StoredAlpha::multiplied);
  } else if (is_jpeg(bytes)) {
    if (!jpeg_is_whole(bytes)) refuse_damaged(path, "it ends too early");
    opened = open_jpeg_bytes(bytes);
  } else {
    opened = open_picture_file(path);
    if (!opened.reader) refuse_channel(path, fmt::format("is not {}, expected PNG, PFM or EXR", what));
  }
  if (!opened.reader) refuse_damaged(path, std::move(opened.complaint));
  return first_channel(*opened.reader, path, what, colours);
}

}  // namespace wheatstone
