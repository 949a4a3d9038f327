#pragma once

#include <span>

#include "wheatstone/calibration/rectify.h"
#include "wheatstone/matching/match_features.h"

namespace wheatstone {

constexpr int least_rectified_side_px = 16;
constexpr std::size_t least_inliers = 24;

/// Throws Error{bad_input} where the pictures' sizes differ or are too small to rectify.
void check_rectifiable(const StereoPair& pair);

/// Whether matches are of one scene. Pictures of different scenes have matches too, and the geometry that most of these
/// happen to agree with has inliers; but they are few against the features, and of few of the matches.
bool shows_one_scene(const EpipolarGeometry& geometry, std::size_t matches, const FeatureMatches& features);

/// Brings the right picture's colours to the left one's where enough `matches`, in the rectified pictures, decide how.
void match_colours(RectifiedPair& pair, std::span<const FeatureMatch> matches);

/// How far from its epipolar line a match may be, in pictures of this longer side; features are found to about half a
/// pixel.
double epipolar_tolerance_px(int longer_side_px);

/// 0 where there are no matches.
VerticalDisparity vertical_disparity(std::span<const FeatureMatch> matches);

}  // namespace wheatstone
