#include "wheatstone/display/floating_window.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wheatstone {
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
