#include "wheatstone/curves/repair.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "wheatstone/stereo/occlusion.h"

namespace wheatstone {
namespace {

bool is_one_surface(const RepairTarget& target, int x, int y, int other_x, int other_y) {
  return std::abs(target.disparity(other_x, other_y) - target.disparity(x, y)) <= target.depth_threshold_px;
}

ColourPoint point_at(const RepairTarget& target, int x, int y) {
  ControlPoint at{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, target.disparity(x, y)};
  at.x = x_in_view(at, target.view, target.reference_view);
  return {at, target.picture(x, y)};
}

/// Evenly over a half to one and a half, whatever the number of lines: multiples of the golden ratio.
float share_of_range(std::size_t number) {
  const double turns = static_cast<double>(number) * std::numbers::phi;
  return static_cast<float>(0.5 + turns - std::floor(turns));
}

}  // namespace

void repair(const RepairTarget& target, DiffusionPainting& painting) {
  constexpr int rim_px = 2;
  const Image<std::uint8_t> wanted = dilate_occlusion(target.places, rim_px);
  for (int y = 0; y < wanted.height(); ++y) {
    bool goes_on = false;
    for (int x = 0; x < wanted.width(); ++x) {
      goes_on = goes_on && wanted(x, y) != 0 && is_one_surface(target, x, y, x - 1, y);
      if (wanted(x, y) == 0) continue;
      if (!goes_on)
        painting.lines.push_back({static_cast<std::uint32_t>(painting.points.size()), 0, target.reference_view,
                                  part_of_range(target, share_of_range(painting.lines.size()))});
      goes_on = true;
      ++painting.lines.back().point_count;
      painting.points.push_back(point_at(target, x, y));
    }
  }
}

}  // namespace wheatstone
