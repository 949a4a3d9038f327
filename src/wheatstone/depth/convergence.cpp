#include "wheatstone/depth/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "wheatstone/percentile.h"

namespace wheatstone {

float depth_from_disparity(float disparity_px, float scale) {
  if (disparity_px == 0) return std::numeric_limits<float>::infinity();
  return disparity_px > 0 ? scale / disparity_px : std::numeric_limits<float>::quiet_NaN();
}

float disparity_percentile(ImageView<const float> disparity, double share) {
  constexpr double enough_px = 1 << 20;
  const double pixels = static_cast<double>(disparity.width()) * disparity.height();
  const int step = std::max(static_cast<int>(std::sqrt(pixels / enough_px)), 1);
  std::vector<float> known;
  known.reserve(static_cast<std::size_t>(pixels / step / step) + 1);
  for (int y = step / 2; y < disparity.height(); y += step) {
    const auto row = disparity.row(y);
    for (int x = step / 2; x < disparity.width(); x += step)
      if (std::isfinite(row[x])) known.push_back(row[x]);
  }
  if (known.empty()) return std::numeric_limits<float>::quiet_NaN();
  return percentile(std::move(known), share);
}

DepthEnds depth_ends(ImageView<const float> disparity) {
  constexpr double outliers = 0.02;
  return {disparity_percentile(disparity, outliers), disparity_percentile(disparity, 1 - outliers)};
}

}  // namespace wheatstone
