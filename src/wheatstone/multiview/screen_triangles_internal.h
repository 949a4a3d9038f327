#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheatstone/depth/rig.h"
#include "wheatstone/models/model.h"
#include "wheatstone/multiview/depth_knots_internal.h"
#include "wheatstone/multiview/model_scene.h"

namespace wheatstone {

/// A triangle of the model, or a part of one, in the central view: in front of the camera, near the views, and between
/// two knots of the depth mapping. Its corners lie on a grid of 1/256 px and have y ascending.
struct ScreenTriangle {
  std::array<float, 3> x, y;           ///< px
  std::array<float, 3> disparity;      ///< px, on the same grid
  std::array<float, 3> depth;          ///< scene units
  std::uint32_t triangle;              ///< of the model
  std::int32_t part;                   ///< index of what part of it this is; -1: the whole
  std::array<std::uint8_t, 3> corner;  ///< of the whole triangle, which is which

  /// A measure that is linear on the screen, and larger for nearer points.
  double nearness(std::size_t k, bool is_orthographic) const {
    return is_orthographic ? -static_cast<double>(depth[k]) : 1. / static_cast<double>(depth[k]);
  }

  /// Twice its area in a view; positive or negative by the side that is seen.
  double area(double view) const {
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<double>(x[k]) - view * static_cast<double>(disparity[k]);
    const double upper = static_cast<double>(y[0]);
    return (at[1] - at[0]) * (static_cast<double>(y[2]) - upper) -
           (at[2] - at[0]) * (static_cast<double>(y[1]) - upper);
  }
  /// Whether a view sees the side that the central view does not.
  bool shows_other_side(double view) const { return area(view) * area(0) < 0; }
};

/// Where the corners of a part lie in its triangle: shares of the triangle's three corners.
using TrianglePart = std::array<std::array<float, 3>, 3>;

struct ScreenTriangles {
  std::vector<ScreenTriangle> triangles;  ///< in the order of the model's
  std::vector<TrianglePart> parts;
};

/// Projects a model's triangles, cuts off what is behind the camera or far beside the views, splits them at the depth
/// mapping's knots, and leaves out what no view between two positions shows. Two triangles with a common edge get the
/// same corners along it.
ScreenTriangles screen_triangles(const Model& model, const ModelScene& scene, const DepthKnots& knots, const Rig& rig);

}  // namespace wheatstone
