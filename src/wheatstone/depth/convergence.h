#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/image/known_runs.h"

namespace wheatstone {

/// Depth, a length, of a point of the given disparity: s / d (Stavrakis & Gelautz 2005, sec. 3.1). `scale` is s, the
/// camera separation times the focal length in pixels. Disparity 0 is infinitely far; a negative one has no depth.
float depth_from_disparity(float disparity_px, float scale);

/// The disparity below which the given share, 0..1, of the finite pixels lies: 0.995 is the nearest point, but for
/// outliers. Of a large picture every few rows and columns are looked at. NaN where no pixel is finite.
float disparity_percentile(ImageView<const float> disparity, double share);

/// A scene's nearest and farthest disparities, but for outliers.
struct DepthEnds {
  float farthest_px = 0, nearest_px = 0;
  float middle_px() const { return (farthest_px + nearest_px) / 2; }
};

/// How much of the width two eyes' pictures share that are moved against each other so that a disparity comes to lie on
/// the screen. Throws Error{wrong_usage} unless it is a quarter at least: less is no picture of the scene.
double shared_width(int width_px, double screen_disparity_px);

/// NaN where no pixel is finite.
DepthEnds depth_ends(ImageView<const float> disparity);
DepthEnds depth_ends(const KnownRuns& disparity);

}  // namespace wheatstone
