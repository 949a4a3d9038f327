#pragma once

#include <span>

#include "wheatstone/calibration/rectify.h"
#include "wheatstone/matching/match_features.h"

namespace wheatstone {

/// How far from its epipolar line a match may be, in pictures of this longer side; features are found to about half a
/// pixel.
double epipolar_tolerance_px(int longer_side_px);

/// 0 where there are no matches.
VerticalDisparity vertical_disparity(std::span<const FeatureMatch> matches);

}  // namespace wheatstone
