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
  std::vector<float> known;
  known.reserve(static_cast<std::size_t>(disparity.width()) * disparity.height());
  for (int y = 0; y < disparity.height(); ++y)
    std::ranges::copy_if(disparity.row(y), std::back_inserter(known), [](float d) { return std::isfinite(d); });
  if (known.empty()) return std::numeric_limits<float>::quiet_NaN();
  return percentile(std::move(known), share);
}

DepthEnds depth_ends(ImageView<const float> disparity) {
  constexpr double outliers = 0.02;
  return {disparity_percentile(disparity, outliers), disparity_percentile(disparity, 1 - outliers)};
}

}  // namespace wheatstone
