#pragma once

#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// A view beside the eyes: what it sees of what the photographs show, and the part that they do not show, where the
/// farther surface beside it goes on, with its colours mirrored.
struct OuterView {
  ViewPosition position;
  Image<Rgb8> picture;
  Image<float> disparity;         ///< no unknowns
  Image<std::uint8_t> uncovered;  ///< 255 for what no photograph shows
  int left_px = 0;                ///< column, in the photographs' own geometry, at which the pictures begin
};

/// What a view beside the eyes sees, in pictures of the photographs' size. They are shifted by whole pixels so that a
/// point of the disparity `zero_parallax_px` has about the same column in them as in the central view: they show what a
/// display shows.
OuterView make_outer_view(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewPosition view,
                          float zero_parallax_px);

}  // namespace wheatstone
