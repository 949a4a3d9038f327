#pragma once

#include <array>
#include <span>
#include <vector>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A place in a picture, in pixels: x to the right, y down, the centre of the first pixel at (½, ½).
struct PicturePoint {
  double x = 0;
  double y = 0;
};

/// The same small thing seen in both pictures.
struct FeatureMatch {
  PicturePoint left, right;
};

struct FeatureOptions {
  int most_features = 6000;     ///< a picture
  int search_side_px = 1600;    ///< larger pictures are searched in a copy reduced to this longer side
  double best_to_second = 0.7;  ///< a match must be this much closer than the next likely one (Lowe 2004)
};

/// What two pictures have in common.
struct FeatureMatches {
  std::vector<FeatureMatch> matches;
  int left_features = 0;  ///< found in each picture, matched or not
  int right_features = 0;
};

/// Distinctive points (SIFT, Lowe 2004) that are each other's best match. Knows nothing of the pair's geometry: some
/// matches are wrong. The pictures may differ in size. The same on every run and any number of threads.
FeatureMatches match_features(ImageView<const Rgb8> left, ImageView<const Rgb8> right,
                              const FeatureOptions& options = {});

/// What a pair of cameras allows: a point of the right picture lies on a line that its left counterpart decides.
struct EpipolarGeometry {
  std::array<double, 9> fundamental{};  ///< F, row by row: right' · F · left = 0, homogeneous, in our pixels
  std::vector<FeatureMatch> inliers;    ///< matches within the tolerance of their lines
  int off_plane = 0;  ///< inliers that no single homography explains; where they are few the scene is flat or far, or
                      ///< the camera turned without moving, and F is not decided
};

/// The geometry that most matches agree with (MAGSAC++, Barath et al. 2020). Without inliers where there are fewer than
/// 8 matches or nothing is found. `tolerance_px` is a distance from the epipolar line.
EpipolarGeometry find_epipolar_geometry(std::span<const FeatureMatch> matches, double tolerance_px);

/// How far a match is from fitting F, to first order, in pixels (Sampson's distance), with a sign.
double sampson_distance(const std::array<double, 9>& fundamental, const FeatureMatch& match);

}  // namespace wheatstone
