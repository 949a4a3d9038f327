#include "wheatstone/painting/steady_picture_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace wheatstone {
namespace {

/// The new picture's share where both agree; it grows to all of it as they come to differ by `unlike` in a channel.
constexpr float new_share = 0.25f, unlike = 64;

Rgb8 mixed(Rgb8 now, const SampledColour& before) {
  const float red = static_cast<float>(now.r) - before.r, green = static_cast<float>(now.g) - before.g,
              blue = static_cast<float>(now.b) - before.b;
  const float difference = std::max({std::abs(red), std::abs(green), std::abs(blue)}) / unlike;
  const float share = std::min(new_share + (1 - new_share) * difference * difference, 1.f);
  const auto level = [&](float from, float step) {
    return static_cast<std::uint8_t>(std::lround(from + share * step));
  };
  return {level(before.r, red), level(before.g, green), level(before.b, blue)};
}

}  // namespace

Image<Rgb8> steady_picture(ImageView<const Rgb8> picture, ImageView<const Rgb8> steady_before, const Flow& backward,
                           ImageView<const std::uint8_t> kept) {
  Image<Rgb8> steady(picture.width(), picture.height());
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float there_x = static_cast<float>(x) + 0.5f + backward.x(x, y);
      const float there_y = static_cast<float>(y) + 0.5f + backward.y(x, y);
      steady(x, y) = kept(x, y) == 0 ? picture(x, y) : mixed(picture(x, y), sample(steady_before, there_x, there_y));
    }
  });
  return steady;
}

}  // namespace wheatstone
