#include "wheatstone/display/print_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "wheatstone/display/lettering.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// Takes a number off the front of a text; none where there is none.
template <class Number>
std::optional<Number> take_number(std::string_view& words) {
  Number number{};
  const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), number);
  if (error != std::errc()) return {};
  words.remove_prefix(static_cast<std::size_t>(end - words.data()));
  return number;
}

bool take(std::string_view& words, char letter) {
  if (!words.starts_with(letter)) return false;
  words.remove_prefix(1);
  return true;
}

std::optional<CropShape> parse_shape(std::string_view words) {
  const std::optional<double> width = take_number<double>(words);
  if (!width || !take(words, ':')) return {};
  const std::optional<double> height = take_number<double>(words);
  constexpr double most = 1000;
  if (!height || !words.empty() || !(*width > 0 && *height > 0)) return {};
  if (!(*width / *height <= most && *height / *width <= most)) return {};
  return CropShape{*width, *height};
}

std::optional<CropArea> parse_area(std::string_view words) {
  CropArea area;
  const std::optional<int> width = take_number<int>(words);
  if (!width || !take(words, 'x')) return {};
  const std::optional<int> height = take_number<int>(words);
  if (!height || *width < 1 || *height < 1) return {};
  area.width = *width;
  area.height = *height;
  if (words.empty()) return area;
  for (std::optional<int>* const place : {&area.left, &area.top}) {
    if (!take(words, '+')) return {};
    *place = take_number<int>(words);
    if (!*place || **place < 0) return {};
  }
  return words.empty() ? std::optional(area) : std::nullopt;
}

CropArea area_of(const CropShape& shape, int width, int height) {
  const double scale = std::min(width / shape.width, height / shape.height);
  return {std::clamp(static_cast<int>(std::lround(shape.width * scale)), 1, width),
          std::clamp(static_cast<int>(std::lround(shape.height * scale)), 1, height),
          {},
          {}};
}

}  // namespace

Crop parse_crop(std::string_view words, std::string_view option) {
  if (const std::optional<CropShape> shape = parse_shape(words)) return *shape;
  if (const std::optional<CropArea> area = parse_area(words)) return *area;
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: is '{}', expected WIDTHxHEIGHT+X+Y in pixels, as 1600x900+20+40, WIDTHxHEIGHT for the "
                          "middle, or a shape, as 4:3",
                          option, words));
}

Image<Rgb8> cropped(ImageView<const Rgb8> picture, const Crop& crop) {
  const int width = picture.width(), height = picture.height();
  const auto* const shape = std::get_if<CropShape>(&crop);
  const CropArea area = shape != nullptr ? area_of(*shape, width, height) : std::get<CropArea>(crop);
  const int left = area.left.value_or((width - area.width) / 2), top = area.top.value_or((height - area.height) / 2);
  if (left < 0 || top < 0 || area.width > width - left || area.height > height - top)
    throw Error(ErrorKind::wrong_usage, fmt::format("--crop: {}x{}+{}+{} does not lie within the views of {}x{} pixels",
                                                    area.width, area.height, left, top, width, height));
  Image<Rgb8> part(area.width, area.height);
  for (int y = 0; y < area.height; ++y)
    std::ranges::copy(
        picture.row(top + y).subspan(static_cast<std::size_t>(left), static_cast<std::size_t>(area.width)),
        part.row(y).begin());
  return part;
}

bool has_print_frame(const PrintFrame& frame) { return frame.crop || frame.border || !frame.caption.empty(); }

Image<Rgb8> with_border_and_caption(ImageView<const Rgb8> picture, const PrintFrame& frame) {
  const Border border = frame.border.value_or(Border{});
  const int longer = std::max(picture.width(), picture.height());
  const int width = std::max(
      static_cast<int>(std::lround(border.is_share ? border.width * static_cast<float>(longer) : border.width)), 0);
  int below = width;
  std::optional<Lettering> caption;
  if (!frame.caption.empty()) {
    constexpr int least_letter_px = 12, letters_a_height = 28;
    const int letter = std::max(picture.height() / letters_a_height, least_letter_px);
    caption = set_text(frame.caption, letter, picture.width());
    below = std::max(below, caption->cover.height() + letter);
  }
  Image<Rgb8> framed(picture.width() + 2 * width, picture.height() + width + below, border.colour);
  for (int y = 0; y < picture.height(); ++y) std::ranges::copy(picture.row(y), framed.row(y + width).begin() + width);
  if (!caption) return framed;
  const bool is_light = 2 * border.colour.r + 5 * border.colour.g + border.colour.b > 8 * 128;
  const Rgb8 ink = is_light ? Rgb8{30, 30, 30} : Rgb8{225, 225, 225};
  lay_cover(caption->cover, width, width + picture.height() + (below - caption->cover.height()) / 2, ink, framed);
  return framed;
}

namespace {

/// Of each row, how many pixels from the edge on belong to things before the screen whose place in the other picture
/// lies beyond its edge. `from_edge` 0 is the pixel at the edge.
template <class DisparityAt>
int strip_for(int width, int height, DisparityAt disparity_at, double specks) {
  std::vector<int> wanted(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int from_edge = 0; from_edge < width; ++from_edge) {
      const float disparity = disparity_at(from_edge, y);
      // A pixel is half hidden at most where its centre is shown.
      if (disparity > 0 && static_cast<float>(from_edge) + 0.5f < disparity)
        wanted[static_cast<std::size_t>(y)] = from_edge + 1;
    }
  const auto place = static_cast<std::ptrdiff_t>(std::lround((1 - specks) * (height - 1)));
  std::ranges::nth_element(wanted, wanted.begin() + place);
  return wanted[static_cast<std::size_t>(place)];
}

}  // namespace

FloatingWindow floating_window_for(const StereoGeometryView& geometry, double specks) {
  const ImageView<const float> left = geometry.left_disparity, right = geometry.right_disparity;
  if (left.empty()) return {};
  const int width = left.width(), height = left.height();
  return {strip_for(
              width, height, [&](int x, int y) { return left(x, y); }, specks),
          strip_for(
              width, height, [&](int x, int y) { return right(width - 1 - x, y); }, specks)};
}

}  // namespace wheatstone
