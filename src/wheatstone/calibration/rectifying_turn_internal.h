#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "wheatstone/calibration/rectifying_map.h"
#include "wheatstone/matching/match_features.h"

namespace wheatstone {

/// How two pictures are turned so that the cameras that took them would stand side by side, looking the same way. Each
/// map keeps its picture's middle in its column.
struct RectifyingTurn {
  RectifyingMap left, right;
  std::array<double, 9> fundamental{};  ///< of the straightened pictures, by this model
};

/// What the cameras may have beside their directions, focal length and offset.
enum class LensModel {
  straight,  ///< straight lines are straight in the photographs
  radial,    ///< both lenses bend them alike, around the middle
};

/// The turn with the least rotation, change of scale and shift that explains the matches: cameras with square pixels,
/// principal points in the middle, and a common unknown focal length, but for a relative scale and a vertical offset
/// (after Fusiello & Irsara 2011, "Quasi-Euclidean epipolar rectification of uncalibrated images"). Sampson's distances
/// are minimised robustly together with how far each parameter is from that of an upright rig.
RectifyingTurn find_rectifying_turn(std::span<const FeatureMatch> matches, cv::Size size,
                                    LensModel lens = LensModel::straight);

/// How far a match is from the turn's epipolar geometry, in pixels; never negative.
double miss_of(const RectifyingTurn& turn, const FeatureMatch& match);

/// What is left of the rows' differences is taken out of the right picture: a shift, a turn and a scale along y.
void settle_rows(RectifyingTurn& turn, std::span<const FeatureMatch> matches);

/// As settle_rows, what a smooth field can take out beyond that.
void settle_rows_smoothly(RectifyingTurn& turn, std::span<const FeatureMatch> matches);

/// Matches in the rectified pictures.
std::vector<FeatureMatch> rectified_matches(const RectifyingTurn& turn, std::span<const FeatureMatch> matches);

}  // namespace wheatstone
