#pragma once

#include <array>

#include "wheatstone/matching/match_features.h"

namespace wheatstone {

/// How the places of one photograph come to its rectified picture, in our pixels: radial distortion is taken out, the
/// camera turned, and what then is left of the rows' difference taken out by a smooth field.
struct RectifyingMap {
  int width = 0;  ///< of the photograph
  int height = 0;
  /// s: a place at distance r from the middle, in half diagonals, comes to r / (1 − s r²), the division model of
  /// Fitzgibbon 2001, which fits wide lenses with one number. Above 0 where the lens draws the corners in.
  double straightening = 0;
  std::array<double, 9> homography{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row, from straightened pixels
  /// Pixels added to the row: times 1, x, y, x², xy, y², x³, x²y, xy², y³ of the straightened place, with x and y from
  /// −1/2 to 1/2 over the longer side, around the middle.
  std::array<double, 10> row_correction{};
};

PicturePoint rectified_place(const RectifyingMap& map, PicturePoint in_photograph);

/// The inverse, to well below a hundredth of a pixel.
PicturePoint photograph_place(const RectifyingMap& map, PicturePoint in_rectified);

}  // namespace wheatstone
