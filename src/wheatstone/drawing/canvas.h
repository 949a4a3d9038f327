#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A canvas that is being painted: colour 0..255 in float, and how much of each pixel a brush has touched, 0..1. A
/// pixel less than half touched counts as bare: infinitely far from every colour. The four are planes whose rows are
/// padded by two vectors, so that kernels need no tails; columns from `width` on hold nothing.
struct Canvas {
  static constexpr int widest_vector = 16;  ///< floats

  Canvas(int width, int height, Rgb8 colour);

  int width;
  int height;
  Image<float> red, green, blue, coverage;
};

/// A bare canvas that shows a picture through what is not painted.
Canvas make_canvas(ImageView<const Rgb8> background);

}  // namespace wheatstone
