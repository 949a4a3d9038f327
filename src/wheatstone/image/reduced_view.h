#pragma once

#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// What a view sees, smaller: a part that only it sees is small, and its cost is mostly that of looking at pictures.
/// Where pixels of several surfaces become one, it is of the farthest that is wanted, and has that one's colour: paint
/// of a nearer one would spill over what lies behind it. A last row or column that is not whole is left out.
struct ReducedView {
  /// Wanted pixels, of the whole view, that lie before the surface of the pixel that they became part of, or became
  /// part of none: those of a square.
  struct LeftOut {
    float x, y;       ///< their middle
    float disparity;  ///< in the view's pixels
    Rgb8 colour;
  };

  int reduction = 1;
  Image<Rgb8> photograph;
  Image<float> disparity;         ///< in reduced pixels
  Image<std::uint8_t> seeds;      ///< not 0 where any of the pixels' is not; empty: everywhere
  std::vector<LeftOut> left_out;  ///< none where all is wanted
  int left_out_px = 2;            ///< the sides of the squares
};

/// The three are of one size, or `seeds` is empty: all is wanted; `reduction` is 1 or more. What is left out is told in
/// squares with sides of `left_out_px`.
ReducedView reduced(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                    ImageView<const std::uint8_t> seeds, int reduction, int left_out_px = 2);

}  // namespace wheatstone
