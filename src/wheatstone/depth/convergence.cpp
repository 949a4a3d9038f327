#include "wheatstone/depth/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/percentile.h"

namespace wheatstone {

float depth_from_disparity(float disparity_px, float scale) {
  if (disparity_px == 0) return std::numeric_limits<float>::infinity();
  return disparity_px > 0 ? scale / disparity_px : std::numeric_limits<float>::quiet_NaN();
}

namespace {

/// The known disparities of enough pixels of an ImageView or KnownRuns.
template <class Map>
std::vector<float> known_disparities(const Map& disparity) {
  constexpr double enough_px = 1 << 18;
  const double pixels = static_cast<double>(disparity.width()) * disparity.height();
  const int step = std::max(static_cast<int>(std::sqrt(pixels / enough_px)), 1);
  std::vector<float> known;
  known.reserve(static_cast<std::size_t>(pixels / step / step) + 1);
  const auto first = [&](int size) { return std::clamp(step / 2, 0, std::max(size - 1, 0)); };
  for (int y = first(disparity.height()); y < disparity.height(); y += step)
    for (int x = first(disparity.width()); x < disparity.width(); x += step)
      if (const float here = disparity(x, y); std::isfinite(here)) known.push_back(here);
  return known;
}

float percentile_of(std::vector<float> known, double share) {
  return known.empty() ? std::numeric_limits<float>::quiet_NaN() : percentile(std::move(known), share);
}

DepthEnds ends_of(std::vector<float> known) {
  constexpr double outliers = 0.02;
  const float farthest = percentile_of(known, outliers);
  return {farthest, percentile_of(std::move(known), 1 - outliers)};
}

}  // namespace

float disparity_percentile(ImageView<const float> disparity, double share) {
  return percentile_of(known_disparities(disparity), share);
}

DepthEnds depth_ends(ImageView<const float> disparity) { return ends_of(known_disparities(disparity)); }
DepthEnds depth_ends(const KnownRuns& disparity) { return ends_of(known_disparities(disparity)); }

double shared_width(int width_px, double screen_disparity_px) {
  constexpr double least_share = 0.25;
  const double shared = width_px - std::abs(screen_disparity_px);
  if (!(shared >= least_share * width_px))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("screen disparity: is {} px, with which the eyes' pictures share {:.0f} of {} px, expected "
                            "a quarter at least",
                            static_cast<float>(screen_disparity_px), shared > 0 ? shared : 0, width_px));
  return shared;
}

}  // namespace wheatstone
