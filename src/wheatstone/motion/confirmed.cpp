// Which flow the other direction confirms.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"
#include "wheatstone/motion/flow.h"

namespace wheatstone {
namespace {

/// Squared length of the gradient, by central differences; one-sided at the border.
float squared_gradient(const Image<float>& image, int x, int y) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, image.width() - 1);
  const int top = std::max(y - 1, 0), bottom = std::min(y + 1, image.height() - 1);
  const float across = (image(right, y) - image(left, y)) / static_cast<float>(std::max(right - left, 1));
  const float down = (image(x, bottom) - image(x, top)) / static_cast<float>(std::max(bottom - top, 1));
  return across * across + down * down;
}

bool is_confirmed(const Flow& own, const Flow& other, int x, int y) {
  const float bx = own.x(x, y), by = own.y(x, y);
  const float there_x = static_cast<float>(x) + 0.5f + bx, there_y = static_cast<float>(y) + 0.5f + by;
  const auto width = static_cast<float>(own.x.width()), height = static_cast<float>(own.x.height());
  // Comparisons with the unknown are false.
  if (!(there_x >= 0 && there_x < width && there_y >= 0 && there_y < height)) return false;
  const float fx = sample(other.x.view(), there_x, there_y), fy = sample(other.y.view(), there_x, there_y);
  const float gradient = squared_gradient(own.x, x, y) + squared_gradient(own.y, x, y);
  return undo_each_other(fx, fy, bx, by) && gradient <= 0.01f * (bx * bx + by * by) + 0.002f;
}

}  // namespace

Image<std::uint8_t> confirmed(const Flow& own, const Flow& other) {
  for (const Image<float>* image : {&own.y, &other.x, &other.y})
    if (!same_size(*image, own.x)) throw Error(ErrorKind::bad_input, "flows of different sizes");
  Image<std::uint8_t> mask(own.x.width(), own.x.height());
  tbb::parallel_for(0, mask.height(), [&](int y) {
    for (int x = 0; x < mask.width(); ++x) mask(x, y) = is_confirmed(own, other, x, y) ? 255 : 0;
  });
  return mask;
}

}  // namespace wheatstone
