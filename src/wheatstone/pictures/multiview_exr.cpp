#include "wheatstone/pictures/multiview_exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <type_traits>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

constexpr std::array<const char*, 3> letters{"R", "G", "B"};
constexpr std::size_t most_views = 1000;

std::string channel_name(const std::vector<std::string>& views, std::size_t view, std::size_t channel) {
  return view == 0 ? letters[channel] : fmt::format("{}.{}", views[view], letters[channel]);
}

std::vector<std::string> views_named_in(const StoredPicture& picture) {
  std::vector<std::string> names = picture.value_of<std::vector<std::string>>("multiView", {});
  if (names.size() > most_views) names.resize(most_views);
  return names;
}

}  // namespace

std::vector<std::string> view_names(std::size_t count) {
  if (count == 2) return {"left", "right"};
  std::vector<std::string> names;
  for (std::size_t v = 0; v < count; ++v) names.push_back(fmt::format("view{:02}", v));
  return names;
}

namespace {

float light_of(std::uint8_t code) { return linear_from_srgb(code); }
float light_of(std::uint16_t code) { return linear_from_deep_srgb(code); }

/// One view is an ordinary picture; of more, the attribute tells their names.
template <class Pixel>
void write_views(const std::filesystem::path& path, std::span<const ImageView<const Pixel>> views) {
  const int width = views.front().width(), height = views.front().height();
  const std::size_t channels = 3 * views.size();
  StoredPicture picture{width, height, static_cast<int>(channels)};
  picture.kind = halves_kind;
  const std::vector<std::string> names = view_names(views.size());
  for (std::size_t i = 0; i < channels; ++i) picture.channel_names.push_back(channel_name(names, i / 3, i % 3));
  if (views.size() > 1) picture.put("multiView", names);
  picture.put("oiio:ColorSpace", "Linear");
  picture.put("compression", "zip");
  // Otherwise the time of writing: the same views are to be the same bytes.
  picture.put("DateTime", "1970:01:01 00:00:00");

  // Encoded in memory and written by us: OpenEXR does not notice when a full disk swallows its last bytes.
  std::vector<unsigned char> bytes;
  const std::unique_ptr<PictureWriter> writer = picture_writer(".exr", bytes);
  const auto check = [&](bool done) {
    if (!done)
      throw Error(ErrorKind::cannot_read_write,
                  fmt::format("{}: cannot write: {}", path.string(), writer->complaint()));
  };
  check(writer->begin({&picture, 1}));
  std::vector<float> line(static_cast<std::size_t>(width) * channels);
  for (int y = 0; y < height; ++y) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto row = views[v].row(y);
      for (std::size_t x = 0; x < row.size(); ++x) {
        float* const to = line.data() + x * channels + 3 * v;
        to[0] = light_of(row[x].r);
        to[1] = light_of(row[x].g);
        to[2] = light_of(row[x].b);
      }
    }
    check(writer->write({line.data(), floats_kind, y, 1, static_cast<std::ptrdiff_t>(line.size() * sizeof(float))}));
  }
  check(writer->end());
  write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

template <class Pixel>
void write_multiview(const std::filesystem::path& path, std::span<const Image<Pixel>> views) {
  if (views.size() < 2 || views.size() > most_views)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: {} views, expected 2 to {}", path.string(), views.size(), most_views));
  for (const Image<Pixel>& view : views)
    if (view.empty() || !same_size(view, views.front()))
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: views of different sizes, expected one", path.string()));
  const std::vector<ImageView<const Pixel>> borrowed(views.begin(), views.end());
  write_views(path, std::span(borrowed));
}

template <class Pixel>
std::vector<Image<Pixel>> read_views(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
  };
  const auto [reader, complaint] = open_picture_file(path);
  if (!reader) refuse(fmt::format("cannot be read, expected an OpenEXR: {}", complaint));
  const StoredPicture& stored = reader->picture();
  const std::vector<std::string> names = views_named_in(stored);
  if (names.size() < 2) refuse("has no multiView attribute, expected two or more views");
  constexpr int most_pixels = 1 << 28;
  if (stored.width < 1 || stored.height < 1 || stored.width > most_pixels / stored.height || stored.channels < 1)
    refuse(fmt::format("has {}x{} pixels", stored.width, stored.height));
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < 3 * names.size(); ++i) {
    const std::string wanted = channel_name(names, i / 3, i % 3);
    const auto found = std::ranges::find(stored.channel_names, wanted);
    if (found == stored.channel_names.end()) refuse(fmt::format("has no channel {}", wanted));
    channels.push_back(static_cast<std::size_t>(found - stored.channel_names.begin()));
  }
  std::vector<Image<Pixel>> views(names.size(), Image<Pixel>(stored.width, stored.height));
  const auto stride = static_cast<std::size_t>(stored.channels);
  std::vector<float> line(static_cast<std::size_t>(stored.width) * stride);
  const auto encoded = [](float light) {
    if constexpr (std::is_same_v<Pixel, Rgb16>)
      return deep_srgb_from_linear(light);
    else
      return srgb_from_linear(light);
  };
  for (int y = 0; y < stored.height; ++y) {
    if (!reader->read(y, 1, stored.channels, line.data()))
      refuse(fmt::format("is damaged or cut short: {}", reader->complaint()));
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto to = views[v].row(y);
      for (std::size_t x = 0; x < to.size(); ++x) {
        const auto light = [&](std::size_t c) { return encoded(line[x * stride + channels[3 * v + c]]); };
        to[x] = {light(0), light(1), light(2)};
      }
    }
  }
  return views;
}

}  // namespace

void write_multiview_exr(const std::filesystem::path& path, std::span<const Image<Rgb8>> views) {
  write_multiview(path, views);
}

void write_multiview_exr(const std::filesystem::path& path, std::span<const Image<Rgb16>> views) {
  write_multiview(path, views);
}

void write_picture_exr(const std::filesystem::path& path, ImageView<const Rgb8> picture) {
  write_views<Rgb8>(path, {&picture, 1});
}

void write_picture_exr(const std::filesystem::path& path, ImageView<const Rgb16> picture) {
  write_views<Rgb16>(path, {&picture, 1});
}

bool is_multiview_exr(const std::filesystem::path& path) {
  std::error_code error;
  if (path.extension() != ".exr" || !std::filesystem::exists(path, error)) return false;
  const std::unique_ptr<PictureReader> reader = open_picture_file(path).reader;
  return reader && views_named_in(reader->picture()).size() > 1;
}

std::vector<Image<Rgb8>> read_multiview_exr(const std::filesystem::path& path) { return read_views<Rgb8>(path); }

std::vector<Image<Rgb16>> read_deep_multiview_exr(const std::filesystem::path& path) { return read_views<Rgb16>(path); }

}  // namespace wheatstone
