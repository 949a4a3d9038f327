#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// What a view sees, at half size: a part that only it sees is small, and its cost is mostly that of looking at
/// pictures. An odd last row or column is left to its neighbours' strokes.
struct HalfView {
  static constexpr int reduction = 2;
  Image<Rgb8> photograph;
  Image<float> disparity;     ///< in half-size pixels
  Image<std::uint8_t> seeds;  ///< not 0 where any of the four pixels' is not
};

/// The three are of one size.
HalfView halved(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                ImageView<const std::uint8_t> seeds);

}  // namespace wheatstone
