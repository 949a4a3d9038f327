#include "wheatstone/painting/mosaic.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/painting/orientation_field_internal.h"
#include "wheatstone/painting/outline_internal.h"
#include "wheatstone/painting/tiling_internal.h"

namespace wheatstone {
namespace {

/// The joint's brightness, as a multiple of the tile's, and half its width, for a picture 640 pixels wide.
constexpr double joint_light = 0.45;
constexpr float half_joint_px = 0.55f;

Rgb8 colour_of(const RegionMeans& means, double light) {
  const auto level = [&](double value) { return static_cast<std::uint8_t>(std::lround(light * value)); };
  return {level(means.red), level(means.green), level(means.blue)};
}

/// Where a corner between two sides of a polygon comes to lie when both move inwards: along the bisector, and no
/// farther than twice as far.
ControlPoint moved_inwards(const ControlPoint& before, const ControlPoint& at, const ControlPoint& after, float inset) {
  const auto normal = [](const ControlPoint& from, const ControlPoint& to) {
    const float dx = to.x - from.x, dy = to.y - from.y, length = std::max(std::hypot(dx, dy), 1e-6f);
    return Direction{dy / length, -dx / length};
  };
  const Direction a = normal(before, at), b = normal(at, after);
  const float x = a.x + b.x, y = a.y + b.y;
  const float squared = std::max(x * x + y * y, 1.f);
  return {at.x + 2 * inset * x / squared, at.y + 2 * inset * y / squared, at.disparity};
}

/// The glass of a tile: its polygon without the joint. Rings have their region to the left, y down.
void add_face(const PolygonMark& joint, Rgb8 colour, float inset, PolygonPainting& painting) {
  PolygonMark face = joint;
  face.colour = colour;
  face.first_ring = static_cast<std::uint32_t>(painting.rings.size());
  for (std::uint32_t r = 0; r < joint.ring_count; ++r) {
    const Ring ring = painting.rings[joint.first_ring + r];
    const auto first = static_cast<std::uint32_t>(painting.points.size());
    for (std::uint32_t i = 0; i < ring.point_count; ++i) {
      const auto point = [&](std::uint32_t k) { return painting.points[ring.first_point + k % ring.point_count]; };
      painting.points.push_back(moved_inwards(point(i + ring.point_count - 1), point(i), point(i + 1), inset));
    }
    painting.rings.push_back({first, ring.point_count});
  }
  painting.marks.push_back(face);
}

void cut_tiles(const ViewToCut& view, const Style& style, PolygonPainting& painting) {
  const RegionMap regions = lay_tiles(view, style.tile_px * view.scale);
  const std::size_t first = painting.marks.size();
  add_outlines(regions, view.disparity, view.view,
               {.tolerance_px = 0.9f, .depth_threshold_px = view.depth_threshold_px}, painting);
  const std::vector<RegionMeans> means = means_of(regions, view.photograph, view.disparity);
  for (std::size_t i = 0; i < means.size(); ++i) {
    PolygonMark& joint = painting.marks[first + i];
    joint.colour = colour_of(means[i], joint_light);
    joint.disparity = static_cast<float>(means[i].disparity);
    joint.views = view.views;
  }
  // All faces after all joints: at drawing, marks of one depth keep their order.
  for (std::size_t i = 0; i < means.size(); ++i)
    add_face(PolygonMark(painting.marks[first + i]), colour_of(means[i], 1), half_joint_px * view.scale, painting);
}

}  // namespace

PolygonPainting plan_mosaic(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style) {
  return plan_polygons(photographs, geometry, style, cut_tiles);
}

}  // namespace wheatstone
