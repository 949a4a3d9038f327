#pragma once

#include <cstddef>
#include <vector>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_mapping.h"

namespace wheatstone {

/// A depth mapping whose disparity, between two neighbours of these depths, is linear on the screen over any triangle:
/// in 1/depth in perspective, in depth where the camera is orthographic. Beyond its ends it stays what it is there.
class DepthKnots {
 public:
  /// Off by less than 1/16 px.
  DepthKnots(const DepthMapping& mapping, const Camera& camera);

  /// The disparity from the screen plane, in pixels.
  double disparity(double depth) const;
  /// The number of knots that are nearer than a depth, or at it.
  std::size_t segment_of(double depth) const;
  /// Ascending.
  const std::vector<double>& depths() const { return depths_; }

 private:
  double along(double depth) const { return is_orthographic_ ? depth : -1 / depth; }
  void add(double depth, double disparity);

  bool is_orthographic_;
  std::vector<double> depths_, along_, disparities_;
};

}  // namespace wheatstone
