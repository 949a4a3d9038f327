#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// What a view sees, smaller: a part that only it sees is small, and its cost is mostly that of looking at pictures. A
/// last row or column that is not whole is left to its neighbours' strokes.
struct ReducedView {
  int reduction = 1;
  Image<Rgb8> photograph;
  Image<float> disparity;     ///< in reduced pixels
  Image<std::uint8_t> seeds;  ///< not 0 where any of the pixels' is not
};

/// The three are of one size; `reduction` is 1 or more.
ReducedView reduced(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                    ImageView<const std::uint8_t> seeds, int reduction);

}  // namespace wheatstone
