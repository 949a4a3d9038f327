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

  /// What is linear on the screen and larger where it is nearer.
  double nearness(std::size_t k, bool is_orthographic) const {
    return is_orthographic ? -static_cast<double>(depth[k]) : 1. / static_cast<double>(depth[k]);
  }
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
