#include "wheatstone/pictures/multiview_exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

constexpr std::array<const char*, 3> letters{"R", "G", "B"};
constexpr std::size_t most_views = 1000;

std::string name_to_write(const std::vector<std::string>& views, std::size_t view, std::size_t channel) {
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
  for (std::size_t i = 0; i < channels; ++i) picture.channel_names.push_back(name_to_write(names, i / 3, i % 3));
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

/// An OpenEXR of several views that is open.
class OpenedViews {
 public:
  explicit OpenedViews(const std::filesystem::path& path) : path_(path) {
    auto [reader, complaint] = open_picture_file(path);
    if (!reader) refuse(fmt::format("cannot be read, expected an OpenEXR: {}", complaint));
    reader_ = std::move(reader);
    const StoredPicture& stored = reader_->picture();
    names_ = views_named_in(stored);
    if (names_.size() < 2) refuse("has no multiView attribute, expected two or more views");
    constexpr int most_pixels = 1 << 28;
    if (stored.width < 1 || stored.height < 1 || stored.width > most_pixels / stored.height || stored.channels < 1)
      refuse(fmt::format("has {}x{} pixels", stored.width, stored.height));
  }

  int width() const { return reader_->picture().width; }
  int height() const { return reader_->picture().height; }
  std::size_t count() const { return names_.size(); }

  /// The place of a view's channel: "R" or "right.R".
  std::optional<std::size_t> find(std::size_t view, std::string_view channel) const {
    return place_of([name = plain_name(view, channel)](const std::string& stored) { return stored == name; });
  }

  /// The place of a view's channel in the first layer that has the pass: "Layer.Pass.right.R", as Blender names it.
  std::optional<std::size_t> find_in_pass(std::size_t view, std::string_view pass, std::string_view channel) const {
    const std::string ending = fmt::format(".{}.{}.{}", pass, names_[view], channel);
    return place_of([&](const std::string& stored) { return stored.ends_with(ending); });
  }

  [[noreturn]] void refuse_without(std::size_t view, std::string_view channel) const {
    refuse(fmt::format("has no channel {}", plain_name(view, channel)));
  }

  /// Calls `take(y, line, stride)` with all channels of each row, pixel after pixel.
  template <class Take>
  void read_rows(Take take) {
    constexpr int rows_at_a_time = 64;  // to convert any number of half floats, OpenImageIO takes 64 MB anew
    const auto stride = static_cast<std::size_t>(reader_->picture().channels);
    const std::size_t numbers_a_row = static_cast<std::size_t>(width()) * stride;
    std::vector<float> lines(numbers_a_row * static_cast<std::size_t>(std::min(rows_at_a_time, height())));
    for (int top = 0; top < height(); top += rows_at_a_time) {
      const int rows = std::min(rows_at_a_time, height() - top);
      if (!reader_->read(top, rows, reader_->picture().channels, lines.data()))
        refuse(fmt::format("is damaged or cut short: {}", reader_->complaint()));
      for (int row = 0; row < rows; ++row)
        take(top + row,
             std::span<const float>(lines).subspan(static_cast<std::size_t>(row) * numbers_a_row, numbers_a_row),
             stride);
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path_.string(), what));
  }

  std::string plain_name(std::size_t view, std::string_view channel) const {
    return view == 0 ? std::string(channel) : fmt::format("{}.{}", names_[view], channel);
  }

  template <class IsWanted>
  std::optional<std::size_t> place_of(IsWanted is_wanted) const {
    const std::vector<std::string>& stored = reader_->picture().channel_names;
    const auto found = std::ranges::find_if(stored, is_wanted);
    if (found == stored.end()) return {};
    return static_cast<std::size_t>(found - stored.begin());
  }

  const std::filesystem::path& path_;
  std::unique_ptr<PictureReader> reader_;
  std::vector<std::string> names_;
};

template <class Pixel>
std::vector<Image<Pixel>> read_views(const std::filesystem::path& path) {
  OpenedViews opened(path);
  std::vector<std::size_t> channels;
  for (std::size_t v = 0; v < opened.count(); ++v)
    for (const char* letter : letters) {
      const std::optional<std::size_t> plain = opened.find(v, letter);
      const std::optional<std::size_t> place = plain ? plain : opened.find_in_pass(v, "Combined", letter);
      if (!place) opened.refuse_without(v, letter);
      channels.push_back(*place);
    }
  std::vector<Image<Pixel>> views(opened.count(), Image<Pixel>(opened.width(), opened.height()));
  const auto encoded = [](float light) {
    if constexpr (std::is_same_v<Pixel, Rgb16>)
      return deep_srgb_from_linear(light);
    else
      return srgb_from_linear(light);
  };
  opened.read_rows([&](int y, std::span<const float> line, std::size_t stride) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto to = views[v].row(y);
      for (std::size_t x = 0; x < to.size(); ++x) {
        const auto light = [&](std::size_t c) { return encoded(line[x * stride + channels[3 * v + c]]); };
        to[x] = {light(0), light(1), light(2)};
      }
    }
  });
  return views;
}

/// The place of a view's depth, if it has one. In Blender's passes, a channel of one number is called Z or V.
std::optional<std::size_t> find_depth(const OpenedViews& opened, std::size_t view) {
  std::optional<std::size_t> place = opened.find(view, "Z");
  for (const char* letter : {"Z", "V"})
    if (!place) place = opened.find_in_pass(view, "Depth", letter);
  return place;
}

/// A picture that a channel is read to, as it stands there times `sign`.
struct ChannelToRead {
  std::size_t place;
  Image<float>* to;
  float sign;
};

/// The channels of a view's passes. Blender's vectors point up, X and Y from here to the frame before, Z and W from the
/// frame after to here (Cycles, primitive_motion_vector).
void add_channels(const OpenedViews& opened, std::size_t view, RenderedPasses& passes,
                  std::vector<ChannelToRead>& channels) {
  const std::optional<std::size_t> depth = find_depth(opened, view);
  if (!depth) opened.refuse_without(view, "Z");
  channels.push_back({*depth, &passes.depth, 1});
  const std::array<ChannelToRead, 4> motion{
      {{0, &passes.before_x, 1}, {0, &passes.before_y, -1}, {0, &passes.after_x, -1}, {0, &passes.after_y, 1}}};
  constexpr std::array<const char*, 4> axes{"X", "Y", "Z", "W"};
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (const auto place = opened.find_in_pass(view, "Vector", axes[i]))
      channels.push_back({*place, motion[i].to, motion[i].sign});
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

bool has_rendered_passes(const std::filesystem::path& path) {
  if (!is_multiview_exr(path)) return false;
  const OpenedViews opened(path);
  for (std::size_t v = 0; v < opened.count(); ++v)
    if (!find_depth(opened, v)) return false;
  return true;
}

std::vector<RenderedPasses> read_rendered_passes(const std::filesystem::path& path) {
  OpenedViews opened(path);
  std::vector<RenderedPasses> passes(opened.count());
  std::vector<ChannelToRead> channels;
  for (std::size_t v = 0; v < passes.size(); ++v) add_channels(opened, v, passes[v], channels);
  for (const ChannelToRead& channel : channels) *channel.to = Image<float>(opened.width(), opened.height());
  opened.read_rows([&](int y, std::span<const float> line, std::size_t stride) {
    for (const auto& [place, to, sign] : channels)
      for (std::size_t x = 0; x < to->row(y).size(); ++x) to->row(y)[x] = sign * line[x * stride + place];
  });
  return passes;
}

std::vector<Image<Rgb8>> read_multiview_exr(const std::filesystem::path& path) { return read_views<Rgb8>(path); }

std::vector<Image<Rgb16>> read_deep_multiview_exr(const std::filesystem::path& path) { return read_views<Rgb16>(path); }

}  // namespace wheatstone
