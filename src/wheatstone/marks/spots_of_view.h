#pragma once

#include <cstdint>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/view_range.h"

namespace wheatstone {

/// Where the painting of a view has a colour that its photograph has nowhere near, and what is there. All pictures are
/// of one size.
struct SpotsOfView {
  ImageView<const Rgb8> photograph;
  ImageView<const std::uint8_t> spots;  ///< 255 where the painting is wrong
  ImageView<const float> disparity;     ///< of the marks that are to lie there, in pixels
  ViewPosition view, reference_view;    ///< marks are planned in the reference view, that all others be told from it
  ViewRange views;                      ///< in which the marks may be drawn
  float depth_threshold_px = 2;         ///< marks end where disparity jumps by more
};

/// The views in which one of the marks may be drawn, so that the marks come and go one after the other and not all at
/// once: `share` of the range on both sides of the view whose spots these are, which may be more than 1.
inline ViewRange range_of_accent(const SpotsOfView& spots, float share) {
  if (spots.views == all_views) return all_views;
  const auto towards = [&](ViewPosition end) {
    return ViewPosition(spots.view.eye_separations() + share * (end - spots.view));
  };
  return {towards(spots.views.first), towards(spots.views.last)};
}

}  // namespace wheatstone
