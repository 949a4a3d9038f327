#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <span>

#include "wheatstone/matching/match_features.h"

namespace wheatstone {

/// How two pictures are turned so that the cameras that took them would stand side by side, looking the same way.
/// Homographies take our pixels of a picture to those of the turned one; each keeps the picture's middle in its column.
struct RectifyingTurn {
  cv::Matx33d left, right;
  std::array<double, 9> fundamental{};  ///< of the pair as it was, by this model
};

/// The turn with the least rotation, change of scale and shift that explains the matches: cameras with square pixels,
/// principal points in the middle, and a common unknown focal length, but for a relative scale and a vertical offset
/// (after Fusiello & Irsara 2011, "Quasi-Euclidean epipolar rectification of uncalibrated images"). Sampson's distances
/// are minimised robustly together with how far each parameter is from that of an upright rig.
RectifyingTurn find_rectifying_turn(std::span<const FeatureMatch> matches, cv::Size size);

/// What is left of the rows' differences is taken out of the right picture: a shift, a turn and a scale along y.
void settle_rows(RectifyingTurn& turn, std::span<const FeatureMatch> matches, cv::Size size);

cv::Point2d carried(const cv::Matx33d& homography, const PicturePoint& point);

}  // namespace wheatstone
