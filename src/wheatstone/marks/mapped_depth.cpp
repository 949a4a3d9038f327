#include "wheatstone/marks/mapped_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/marks/visit_points_internal.h"

namespace wheatstone {
namespace {

void map_whole_marks(StrokePainting& painting, const DisparityMapping& mapping) {
  for (Layer& layer : painting.layers)
    for (Stroke& stroke : layer.strokes) stroke.disparity = mapped_px(mapping, stroke.disparity);
}
void map_whole_marks(RegionPainting& painting, const DisparityMapping& mapping) {
  for (RegionMark& mark : painting.marks) mark.disparity = mapped_px(mapping, mark.disparity);
}
void map_whole_marks(DiffusionPainting& /*painting*/, const DisparityMapping& /*mapping*/) {}

/// Surfaces keep whole steps.
float in_steps(float disparity_px) { return std::round(disparity_px * disparity_steps) / disparity_steps; }

/// One row of a surface: its disparities before and behind the mapping, and how far the view stands beside the
/// reference view, in which nothing moves.
struct MovedRow {
  std::span<const float> from, to;
  float separation = 0;

  /// Where the middle of a pixel comes to lie.
  float place(int x) const { return static_cast<float>(x) + 0.5f + separation * (from[x] - to[x]); }
  bool is_joined(int x) const {
    return x + 1 < static_cast<int>(from.size()) && std::abs(from[x + 1] - from[x]) <= joined_px;
  }
};

/// Lays a row's surface, the nearest on top, into a row whose first pixel is column `first` of it.
void lay(const MovedRow& row, int first, std::span<float> nearest) {
  const auto land = [&](int column, float disparity) {
    const int at = column - first;
    if (at < 0 || at >= static_cast<int>(nearest.size())) return;
    if (!(nearest[at] >= disparity)) nearest[at] = disparity;
  };
  for (int x = 0; x < static_cast<int>(row.from.size()); ++x) {
    if (std::isnan(row.from[x])) continue;
    const float here = row.place(x);
    land(floor_of(here), row.to[x]);
    if (!row.is_joined(x)) continue;
    // The surface between two pixels covers the centres between the places where they come to lie.
    const float next = row.place(x + 1);
    for (int column = -floor_of(0.5f - here); static_cast<float>(column) + 0.5f < next; ++column) {
      const float share = (static_cast<float>(column) + 0.5f - here) / (next - here);
      land(column, in_steps(row.to[x] + share * (row.to[x + 1] - row.to[x])));
    }
  }
}

Surface mapped(const Surface& surface, float separation, const DisparityMapping& mapping) {
  const Image<float>& from = surface.disparity;
  Surface to = surface;
  float least = 0, most = 0;  // of what pixels move
  for (std::size_t i = 0; i < from.pixels().size(); ++i) {
    const float before = from.pixels()[i];
    if (std::isnan(before)) continue;
    const float behind = to.disparity.pixels()[i] = in_steps(mapped_px(mapping, before));
    least = std::min(least, separation * (before - behind));
    most = std::max(most, separation * (before - behind));
  }
  if (separation == 0) return to;
  // What leaves the picture by more than its width is never seen.
  const auto reach = static_cast<float>(from.width());
  const int first = floor_of(std::max(least, -reach));
  const int last = from.width() + floor_of(std::min(most, reach)) + 1;
  Surface moved{surface.view, Image<float>(last - first, from.height(), std::numeric_limits<float>::quiet_NaN()),
                surface.left_px + first, surface.continued};
  for (int y = 0; y < from.height(); ++y)
    lay({from.row(y), to.disparity.row(y), separation}, first, moved.disparity.row(y));
  return moved;
}

/// As much more or less than before as the whole scene has of depth.
float mapped_tolerance_px(const Surfaces& surfaces, const DisparityMapping& mapping) {
  const DepthEnds ends = depth_ends(surfaces.seen.front().disparity);
  const float before_px = ends.nearest_px - ends.farthest_px;
  if (!(before_px > 0)) return surfaces.tolerance_px;
  const float behind_px = mapped_px(mapping, ends.nearest_px) - mapped_px(mapping, ends.farthest_px);
  return std::max(surfaces.tolerance_px * behind_px / before_px, 1 / disparity_steps);
}

}  // namespace

Painting with_depth(Painting painting, const DisparityMapping& mapping) {
  if (mapping.points.empty()) return painting;
  const ViewPosition reference = painting.surfaces.seen.empty() ? left_eye : painting.surfaces.seen.front().view;
  const auto map_point = [&](ControlPoint& point, ViewPosition view) {
    const float to = mapped_px(mapping, point.disparity);
    point.x += (view - reference) * (point.disparity - to);
    point.disparity = to;
  };
  std::visit(
      [&](auto& marks) {
        visit_points(marks, map_point);
        map_whole_marks(marks, mapping);
      },
      painting.marks);
  Surfaces& surfaces = painting.surfaces;
  if (!surfaces.seen.empty()) surfaces.tolerance_px = mapped_tolerance_px(surfaces, mapping);
  for (Surface& surface : surfaces.seen) surface = mapped(surface, surface.view - reference, mapping);
  return painting;
}

}  // namespace wheatstone
