#pragma once

#include <cstdint>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// Places of a view that are bare, or whose paint is wrong, and what belongs there. All pictures are of one size.
struct RepairTarget {
  ImageView<const Rgb8> picture;
  ImageView<const std::uint8_t> places;  ///< not 0 where marks are wanted
  ImageView<const float> disparity;      ///< of the marks that are to lie there, in pixels
  ViewPosition view, reference_view;     ///< marks are planned in the reference view, that all others be told from it
  ViewRange views = all_views;           ///< in which the marks may be drawn
  float depth_threshold_px = 2;          ///< marks end where disparity jumps by more
};

/// The views in which one of the marks may be drawn, so that the marks come and go one after the other and not all at
/// once: `share` of the range on both sides of the view that is repaired, which may be more than 1.
inline ViewRange part_of_range(const RepairTarget& target, float share) {
  if (target.views == all_views) return all_views;
  const auto towards = [&](ViewPosition end) {
    return ViewPosition(target.view.eye_separations() + share * (end - target.view));
  };
  return {towards(target.views.first), towards(target.views.last)};
}

}  // namespace wheatstone
