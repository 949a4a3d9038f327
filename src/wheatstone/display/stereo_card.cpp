#include "wheatstone/display/stereo_card.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/display/lettering.h"
#include "wheatstone/display/stereo_card_internal.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// How much of a pixel's area lies within a rectangle with round corners; the pixel's centre is given.
double cover_of(double x, double y, double width, double height, double corner) {
  const double from_middle_x = std::abs(x - width / 2) - (width / 2 - corner);
  const double from_middle_y = std::abs(y - height / 2) - (height / 2 - corner);
  const double outside = std::hypot(std::max(from_middle_x, 0.), std::max(from_middle_y, 0.)) +
                         std::min(std::max(from_middle_x, from_middle_y), 0.) - corner;
  return std::clamp(0.5 - outside, 0., 1.);
}

std::uint8_t mixed_by(std::uint8_t below, std::uint8_t over, double share) {
  return static_cast<std::uint8_t>(std::lround(below + (over - below) * share));
}

void lay_window(ImageView<const Rgb8> view, const PaperArea& window, double corner_mm, double px_a_mm,
                const ViewFraming& framing, Image<Rgb8>& card) {
  const double left = window.left_mm * px_a_mm, top = window.top_mm * px_a_mm;
  const double width = window.width_mm * px_a_mm, height = window.height_mm * px_a_mm;
  const int first_x = static_cast<int>(std::floor(left)), first_y = static_cast<int>(std::floor(top));
  const int columns = static_cast<int>(std::ceil(left + width)) - first_x;
  const int rows = static_cast<int>(std::ceil(top + height)) - first_y;
  const Image<Rgb8> picture = framed_view(view, columns, rows, framing);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double share =
          cover_of(first_x + x + 0.5 - left, first_y + y + 0.5 - top, width, height, corner_mm * px_a_mm);
      Rgb8& pixel = card(first_x + x, first_y + y);
      const Rgb8 over = picture(x, y);
      pixel = {mixed_by(pixel.r, over.r, share), mixed_by(pixel.g, over.g, share), mixed_by(pixel.b, over.b, share)};
    }
}

}  // namespace

void refuse_card_caption() {
  throw Error(ErrorKind::wrong_usage, "--caption: is too long for a stereo card, which has about 300 letters of room");
}

StereoCardLayout stereo_card_layout(int view_width, int view_height, const ViewFraming& framing) {
  constexpr double largest_width_mm = 79, largest_height_mm = 72, apart_mm = 83, top_mm = 5, side_mm = 8;
  StereoCardLayout card;
  double width = largest_width_mm, height = largest_height_mm;
  if (framing.whole) {
    const double scale = std::min(width / view_width, height / view_height);
    width = view_width * scale;
    height = view_height * scale;
  }
  const double middle = card.width_mm / 2, below_mm = top_mm + largest_height_mm;
  for (const int eye : {0, 1})
    card.windows[static_cast<std::size_t>(eye)] = {middle + (eye == 0 ? -0.5 : 0.5) * apart_mm - width / 2,
                                                   top_mm + (largest_height_mm - height) / 2, width, height};
  card.caption = {side_mm, below_mm + 1, card.width_mm - 2 * side_mm, card.height_mm - below_mm - 3.6};
  return card;
}

Image<Rgb8> stereo_card_picture(const StereoPairView& pair, const StereoCardOptions& options) {
  const StereoCardLayout layout = stereo_card_layout(pair.left.width(), pair.left.height(), options.framing);
  const double px_a_mm = options.dpi / inch_mm;
  const auto px = [&](double mm) { return static_cast<int>(std::lround(mm * px_a_mm)); };
  Image<Rgb8> card(px(layout.width_mm), px(layout.height_mm), options.mount);
  lay_window(pair.left, layout.windows[0], layout.corner_mm, px_a_mm, options.framing, card);
  lay_window(pair.right, layout.windows[1], layout.corner_mm, px_a_mm, options.framing, card);
  if (options.caption.empty()) return card;
  const PaperArea& place = layout.caption;
  const auto set_at = [&](double letter_mm) {
    return set_text(options.caption, std::max(px(letter_mm), 1), px(place.width_mm));
  };
  const CardCaption caption = fitted_caption(place, [&](double letter_mm) {
    return std::vector<std::string>(static_cast<std::size_t>(set_at(letter_mm).lines));
  });
  const Lettering set = set_at(caption.letter_mm);
  lay_cover(set.cover, px(place.left_mm), px(place.top_mm) + (px(place.height_mm) - set.cover.height()) / 2,
            options.ink, card);
  return card;
}

}  // namespace wheatstone
