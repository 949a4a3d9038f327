#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/calibration/vertical_disparity_internal.h"
#include "wheatstone/percentile.h"

namespace wheatstone {

double epipolar_tolerance_px(int longer_side_px) { return std::max(1.0, longer_side_px / 1000.0); }

VerticalDisparity vertical_disparity(std::span<const FeatureMatch> matches) {
  std::vector<double> differences;
  for (const FeatureMatch& match : matches) differences.push_back(std::abs(match.left.y - match.right.y));
  if (differences.empty()) return {};
  return {percentile(differences, 0.5), percentile(differences, 0.95)};
}

}  // namespace wheatstone
