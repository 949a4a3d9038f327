#pragma once

#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/spline.h"

namespace wheatstone {

struct EdgeOptions {
  double weak = 18, strong = 50;  ///< Canny's thresholds, in luminance
  std::size_t least_points = 6;   ///< shorter chains are noise
  float depth_threshold_px = 2;
  ImageView<const std::uint8_t> known;  ///< where it is not 0 an edge need only be `faintest`; empty: nowhere
  double faintest = 11;                 ///< in luminance
};

/// The picture's edges, and the jumps of its disparity, as chains of points about a pixel apart, smoothed. Where both
/// lie side by side the jump of disparity counts.
std::vector<std::vector<PlanePoint>> find_edge_chains(ImageView<const Rgb8> picture, ImageView<const float> disparity,
                                                      const EdgeOptions& options);

}  // namespace wheatstone
