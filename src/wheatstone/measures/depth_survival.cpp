#include "wheatstone/measures/depth_survival.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/image/known_values.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/plain_sgbm_opencv.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/consistency_internal.h"

namespace wheatstone {
namespace {

/// From nothing, or the truth's least, to its largest, in whole pixels; no farther than the picture is wide.
DisparityRange range_of(ImageView<const float> disparity) {
  const auto [least, largest] = range_with_zero(disparity);
  const auto width = static_cast<float>(disparity.width());
  return {static_cast<int>(std::floor(std::max(least, -width))), static_cast<int>(std::ceil(std::min(largest, width)))};
}

}  // namespace

DepthSurvival measure_depth_survival(const StereoPair& pair, ImageView<const float> left_disparity) {
  check_one_size(pair, left_disparity);
  const Image<float> found = match_plain_sgbm(as_mat(pair.left), as_mat(pair.right), range_of(left_disparity));
  const Image<std::uint8_t> visible = visible_in_both(left_disparity);
  std::size_t asked = 0, matched = 0, within_1 = 0, within_2 = 0;
  double error_sum = 0;
  for (int y = 0; y < visible.height(); ++y) {
    for (int x = 0; x < visible.width(); ++x) {
      if (visible(x, y) == 0) continue;
      ++asked;
      if (!std::isfinite(found(x, y))) continue;
      ++matched;
      const double error = std::abs(found(x, y) - left_disparity(x, y));
      error_sum += error;
      within_1 += error <= 1 ? 1 : 0;
      within_2 += error <= 2 ? 1 : 0;
    }
  }
  DepthSurvival survival;
  if (asked == 0) return survival;
  const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(asked); };
  survival.density = share(matched);
  survival.bad_1 = 1 - share(within_1);
  survival.bad_2 = 1 - share(within_2);
  survival.end_point_error = matched > 0 ? error_sum / static_cast<double>(matched) : 0;
  return survival;
}

}  // namespace wheatstone
