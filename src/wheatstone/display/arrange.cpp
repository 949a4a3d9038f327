#include "wheatstone/display/arrange.h"

#include <algorithm>
#include <cmath>

namespace wheatstone {
namespace {

Image<Rgb8> columns_of(const Image<Rgb8>& picture, int first, int count) {
  Image<Rgb8> part(count, picture.height());
  for (int y = 0; y < picture.height(); ++y)
    std::ranges::copy(picture.row(y).subspan(first, count), part.row(y).begin());
  return part;
}

}  // namespace

Image<Rgb8> side_by_side(const StereoPair& pair) {
  const int width = pair.left.width();
  Image<Rgb8> both(width + pair.right.width(), pair.left.height());
  for (int y = 0; y < both.height(); ++y) {
    std::ranges::copy(pair.left.row(y), both.row(y).begin());
    std::ranges::copy(pair.right.row(y), both.row(y).begin() + width);
  }
  return both;
}

StereoPair translated(const StereoPair& pair, float zero_parallax_px) {
  const int width = pair.left.width();
  const int shift = std::clamp(static_cast<int>(std::lround(zero_parallax_px)), 1 - width, width - 1);
  const int common = width - std::abs(shift);
  return {columns_of(pair.left, std::max(shift, 0), common), columns_of(pair.right, std::max(-shift, 0), common)};
}

}  // namespace wheatstone
