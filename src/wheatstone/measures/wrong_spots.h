#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// An RGB distance, 0..441, above which nobody takes one colour for the other.
inline constexpr float unlike_colours = 60;

/// Whether they are at most that far from each other.
inline bool is_like(Rgb8 a, Rgb8 b) {
  constexpr int most = static_cast<int>(unlike_colours);
  const int red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
  return red * red + green * green + blue * blue <= most * most;
}

/// The distance within which a colour is near, in pixels: 4 in a picture 640 wide, in proportion otherwise.
inline double nearness_px(int width) { return 4.0 * width / 640; }

/// So many wrong pixels that touch each other, at sides or corners, are a spot.
inline constexpr int least_spot_px = 4;

/// In narrower pictures, what is taken for near is less than a pixel away: they are not mended.
inline constexpr int least_judged_width_px = 160;

/// Places of a painting whose colour its photograph has nowhere near, as where paint of one surface lies on another.
struct WrongSpots {
  double spots_per_100000_px = 0;
  double share = 0;  ///< of the pixels, 0..1, that lie in a spot
};

/// Whether a photograph has a colour like this one near a pixel of it. Where many pixels are asked for, ColoursAround
/// is faster.
bool has_colour_near(ImageView<const Rgb8> photograph, Rgb8 colour, int x, int y);

/// The colours of a photograph that are near its pixels.
class ColoursAround {
 public:
  explicit ColoursAround(ImageView<const Rgb8> photograph);

  /// Whether any of those around a pixel is like this one.
  bool has(Rgb8 colour, int x, int y) const;

  // What the kernel reads. Planes go on beside the picture, where its border is repeated: a border pixel is nearer to
  // the middle of a disc than what lies outside.
  Image<std::uint8_t> red, green, blue;
  std::vector<int> half_widths;  ///< of the disc's rows, from its middle one down
};

/// 255 where every pixel of the photograph within 4 pixels (of a picture 640 wide, in proportion otherwise) has an
/// unlike colour. Throws Error{bad_input} where the sizes differ.
Image<std::uint8_t> wrong_pixels(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph);

/// Throws as wrong_pixels.
WrongSpots measure_wrong_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph);

/// Of both eyes together.
WrongSpots measure_wrong_spots(const StereoPairView& painted, const StereoPairView& photographs);

}  // namespace wheatstone
