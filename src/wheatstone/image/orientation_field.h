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

  /// Rounds the field to steps too small to be seen, so that a change of the picture changes it only nearby: what is
  /// interpolated reaches across the whole picture, ever fainter.
  void round();

  /// Calls `visit(left, top, right, bottom)` for parts of the picture, which together hold all pixels within which
  /// `along` may differ from that of a field of the same size and detail. They may reach beyond the picture.
  template <class Visit>
  void visit_differences(const OrientationField& other, Visit visit) const {
    constexpr float neighbour = 1.5f;  // a place takes its direction from the four nearest values
    constexpr int far = 1 << 20;       // values at the border hold beyond it
    const auto begin = [&](int i) {
      return i == 0 ? -far : static_cast<int>((static_cast<float>(i) - neighbour) / scale_) - 1;
    };
    const auto end = [&](int i, int size) {
      return i + 1 == size ? far : static_cast<int>((static_cast<float>(i) + neighbour + 1) / scale_) + 2;
    };
    const auto differ = [](const Image<float>& a, const Image<float>& b, int x, int y) { return a(x, y) != b(x, y); };
    for (int y = 0; y < xx_.height(); ++y)
      for (int x = 0; x < xx_.width(); ++x)
        if (differ(xx_, other.xx_, x, y) || differ(xy_, other.xy_, x, y) || differ(yy_, other.yy_, x, y))
          visit(begin(x), begin(y), end(x, xx_.width()), end(y, xx_.height()));
  }

 private:
  Image<float> xx_, xy_, yy_;  // the tensor, in squared luminance steps a pixel
  float scale_ = 1;            // field pixels a picture pixel
};

}  // namespace wheatstone
