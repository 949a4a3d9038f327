#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A unit vector along which a stroke may run; its sign means nothing.
struct Direction {
  float x = 1;
  float y = 0;
};

/// Which way the picture runs, everywhere, also where it is flat: structure tensors of the strong gradients, spread
/// over the rest by normalised convolution from fine to coarse. Kept at a fraction of the picture's size.
class OrientationField {
 public:
  OrientationField() = default;

  /// `detail_px` is the distance over which directions may differ: about half a brush radius.
  OrientationField(ImageView<const std::uint8_t> luminance, float detail_px);

  /// The direction along the picture's lines at a point, given the luminance gradient there (0..255 a pixel): across
  /// the gradient where it is strong against its surroundings, the field's own where it vanishes.
  Direction along(float x, float y, float gradient_x, float gradient_y) const;

 private:
  Image<float> xx_, xy_, yy_;  // the tensor, in squared luminance steps a pixel
  float scale_ = 1;            // field pixels a picture pixel
};

}  // namespace wheatstone
