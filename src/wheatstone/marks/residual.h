#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// RGB distance, 0..441, above which paint of one colour does not stand for the other.
inline constexpr float unlike_colours = 60;

/// True where two colours are at most that far from each other.
inline bool is_like(Rgb8 a, Rgb8 b) {
  constexpr int most = static_cast<int>(unlike_colours);
  const int red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
  return red * red + green * green + blue * blue <= most * most;
}

/// Radius within which paint may lie beside its place: 4 pixels of a picture 640 wide, in proportion otherwise.
inline double nearness_px(int width) { return 4.0 * width / 640; }

/// Fewer connected pixels of a residual are not repaired.
inline constexpr int least_repaired_px = 4;

/// In narrower pictures the radius is less than a pixel: they are not repaired.
inline constexpr int least_repaired_width_px = 160;

/// The colours of a picture within `nearness_px` of each of its pixels. Borrows the picture.
class NearColours {
 public:
  explicit NearColours(ImageView<const Rgb8> picture);

  /// True where one of those near pixel (x, y) is like this colour.
  bool has(Rgb8 colour, int x, int y) const;

 private:
  ImageView<const Rgb8> picture_;
  std::vector<int> half_widths_;  ///< of the disc's rows, from its middle row on
};

/// 255 where a drawn picture has a colour that its target has nowhere near, 0 elsewhere. Both are of one size.
Image<std::uint8_t> residual(ImageView<const Rgb8> drawn, ImageView<const Rgb8> target);

}  // namespace wheatstone
