#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

/// The points of the first `count` strokes of a layer, those that stay.
class CarriedPoints {
 public:
  CarriedPoints(const TrackedLayer& tracked, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      if (tracked.tracks[i].ends == 0)
        std::ranges::copy(tracked.layer.points_of(tracked.layer.strokes[i]), std::back_inserter(points_));
    std::ranges::sort(points_, {}, &ControlPoint::y);
  }

  /// True where one lies on the same surface at a place, or a pixel beside it: edges are known to a pixel at best.
  bool any_at(const ControlPoint& place, float depth_threshold_px) const {
    constexpr float reach_px = 1;
    for (auto point = std::ranges::lower_bound(points_, place.y - reach_px, {}, &ControlPoint::y);
         point != points_.end() && point->y <= place.y + reach_px; ++point)
      if (std::abs(point->x - place.x) <= reach_px &&
          std::abs(point->disparity - place.disparity) <= depth_threshold_px)
        return true;
    return false;
  }

 private:
  std::vector<ControlPoint> points_;  ///< from the top down
};

}  // namespace wheatstone
