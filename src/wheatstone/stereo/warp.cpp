#include "wheatstone/stereo/warp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wheatstone {
namespace {

/// Neighbours that differ by more than this are different surfaces.
constexpr float joined_px = 1;

/// Where on the other eye's scan line a pixel's centre lands.
float target_of(int x, float disparity, Eye from) {
  return static_cast<float>(x) + 0.5f + (from == Eye::left ? -disparity : disparity);
}

/// Calls `land(x_in_other, disparity, x, t)` for every pixel centre of the other eye's scan line that the surface of
/// this one covers: between the pixels x and x + 1, at the fraction t. Not z-tested; a pixel may be landed on often.
template <class Land>
void warp_row(std::span<const float> disparity, Eye from, Land land) {
  const int width = static_cast<int>(disparity.size());
  const auto land_inside = [&](int target, float d, int x, float t) {
    if (target >= 0 && target < width) land(target, d, x, t);
  };
  for (int x = 0; x < width; ++x) {
    if (!std::isfinite(disparity[x])) continue;
    const float here = target_of(x, disparity[x], from);
    land_inside(static_cast<int>(std::floor(here)), disparity[x], x, 0);
    if (x + 1 == width || !(std::abs(disparity[x + 1] - disparity[x]) <= joined_px)) continue;

    // The surface between two pixels covers the centres between the places where they land.
    const float next = target_of(x + 1, disparity[x + 1], from);
    const int first = static_cast<int>(std::ceil(here - 0.5f)), last = static_cast<int>(std::floor(next - 0.5f));
    for (int target = first; target <= last; ++target) {
      const float t = next > here ? (static_cast<float>(target) + 0.5f - here) / (next - here) : 0;
      land_inside(target, disparity[x] + t * (disparity[x + 1] - disparity[x]), x, t);
    }
  }
}

Rgb8 blend(Rgb8 a, Rgb8 b, float t) {
  const auto mix = [t](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(static_cast<float>(from) + t * static_cast<float>(to - from) + 0.5f);
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

}  // namespace

Image<float> warp_disparity(ImageView<const float> disparity, Eye from) {
  Image<float> warped(disparity.width(), disparity.height(), std::numeric_limits<float>::quiet_NaN());
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto to = warped.row(y);
    warp_row(disparity.row(y), from, [&](int target, float d, int, float) {
      if (!(to[target] >= d)) to[target] = d;
    });
  });
  return warped;
}

WarpedPicture warp_picture(ImageView<const Rgb8> picture, ImageView<const float> disparity, Eye from) {
  const int width = picture.width();
  WarpedPicture warped{Image<Rgb8>(width, picture.height()), Image<std::uint8_t>(width, picture.height())};
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height()), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(width);
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, -std::numeric_limits<float>::infinity());
      const auto colours = picture.row(y);
      const auto to = warped.picture.row(y);
      const auto covered = warped.covered.row(y);
      warp_row(disparity.row(y), from, [&](int target, float d, int x, float t) {
        if (d <= nearest[target]) return;
        nearest[target] = d;
        to[target] = t > 0 ? blend(colours[x], colours[x + 1], t) : colours[x];
        covered[target] = 255;
      });
    }
  });
  return warped;
}

void lay_over(const WarpedPicture& warped, Image<Rgb8>& picture) {
  tbb::parallel_for(0, picture.height(), [&](int y) {
    const auto from = warped.picture.row(y);
    const auto covered = warped.covered.row(y);
    const auto to = picture.row(y);
    for (int x = 0; x < picture.width(); ++x)
      if (covered[x] != 0) to[x] = from[x];
  });
}

}  // namespace wheatstone
