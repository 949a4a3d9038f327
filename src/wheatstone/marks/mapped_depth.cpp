#include "wheatstone/marks/mapped_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/marks/visit_points_internal.h"
#include "wheatstone/percentile.h"

namespace wheatstone {
namespace {

// What becomes of a disparity that the reference view sees at a place is a function `mapped(x, y, disparity)`. Its kind
// is a template's parameter, because it is called for every pixel.

/// Marks for some views only are for those that now show the same. `gain` is how much more depth there is than before.
template <class Marks>
void map_views(Marks& painting, ViewPosition reference, float gain) {
  if (!(gain > 0)) return;
  const auto mapped = [&](ViewPosition view) {
    return ViewPosition(reference.eye_separations() + (view - reference) / gain);
  };
  visit_marks(painting, [&](auto& mark, const auto& /*holder*/) {
    if (mark.views != all_views) mark.views = {mapped(mark.views.first), mapped(mark.views.last)};
  });
}

/// One row of a surface: its disparities before and behind the mapping, and how far the view stands beside the
/// reference view, in which nothing moves.
struct MappedRow {
  std::span<const float> from, to;
  float separation = 0;

  /// Where the middle of a pixel comes to lie.
  float place(int x) const { return static_cast<float>(x) + 0.5f + separation * (from[x] - to[x]); }
  bool is_joined(int x) const {
    return x + 1 < static_cast<int>(from.size()) && std::abs(from[x + 1] - from[x]) <= joined_px;
  }
};

/// Lays a row's surface, the nearest on top, into a row whose first pixel is column `first` of it.
void lay(const MappedRow& row, int first, std::span<float> nearest) {
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
      land(column, in_whole_steps(row.to[x] + share * (row.to[x + 1] - row.to[x])));
    }
  }
}

template <class Mapped>
Surface mapped_surface(const Surface& surface, float separation, const Mapped& mapped) {
  const KnownRuns& from = surface.disparity;
  Surface to = surface;
  float least = 0, most = 0;  // of what pixels move
  for (int y = 0; y < from.height(); ++y)
    for (const KnownRuns::Run& run : from.runs_of(y)) {
      int x = run.begin;
      for (float& disparity : to.disparity.values_of(run)) {
        const float before = disparity;
        const float place = static_cast<float>(surface.left_px + x++) + 0.5f + separation * before;
        disparity = in_whole_steps(mapped(place, static_cast<float>(y) + 0.5f, before));
        least = std::min(least, separation * (before - disparity));
        most = std::max(most, separation * (before - disparity));
      }
    }
  if (separation == 0) return to;
  // What leaves the picture by more than its width is never seen.
  const auto reach = static_cast<float>(from.width());
  const int first = floor_of(std::max(least, -reach));
  const int last = from.width() + floor_of(std::min(most, reach)) + 1;
  Surface moved{surface.view, KnownRuns(last - first, from.height()), surface.left_px + first, surface.continued};
  std::vector<float> before(static_cast<std::size_t>(from.width())), behind(before.size());
  std::vector<float> nearest(static_cast<std::size_t>(last - first));
  for (int y = 0; y < from.height(); ++y) {
    from.copy_row(y, before);
    to.disparity.copy_row(y, behind);
    std::ranges::fill(nearest, std::numeric_limits<float>::quiet_NaN());
    lay({before, behind, separation}, first, nearest);
    moved.disparity.add_row(nearest);
  }
  return moved;
}

/// How much more depth the whole scene has than before.
float gain_of(const DisparityMapping& mapping, const DepthEnds& ends) {
  const float before_px = ends.nearest_px - ends.farthest_px;
  if (!(before_px > 0)) return 1;
  return (mapped_px(mapping, ends.nearest_px) - mapped_px(mapping, ends.farthest_px)) / before_px;
}

/// `gain` is how much more depth there is than before, where there is most.
template <class Mapped>
void map_depth(Painting& painting, float gain, const Mapped& mapped) {
  const ViewPosition reference = painting.surfaces.seen.empty() ? left_eye : painting.surfaces.seen.front().view;
  const auto map_point = [&](ControlPoint& point, ViewPosition view) {
    const float separation = view - reference;
    const float to = mapped(point.x + separation * point.disparity, point.y, point.disparity);
    point.x += separation * (point.disparity - to);
    point.disparity = to;
  };
  std::visit(
      [&](auto& marks) {
        visit_own_disparities(marks, [&](float& disparity, const auto& first_point) {
          disparity = mapped(first_point().x, first_point().y, disparity);
        });
        visit_points(marks, map_point);
        if (!painting.surfaces.seen.empty()) map_views(marks, reference, gain);
      },
      painting.marks);
  Surfaces& surfaces = painting.surfaces;
  if (!surfaces.seen.empty()) surfaces.tolerance_px = std::max(surfaces.tolerance_px * gain, 1 / disparity_steps);
  for (Surface& surface : surfaces.seen) surface = mapped_surface(surface, surface.view - reference, mapped);
}

DepthEnds ends_of(const Surfaces& surfaces) {
  return surfaces.seen.empty() ? DepthEnds() : depth_ends(surfaces.seen.front().disparity);
}

}  // namespace

Painting with_depth(Painting painting, const DisparityMapping& mapping) {
  if (mapping.points.empty()) return painting;
  map_depth(painting, gain_of(mapping, ends_of(painting.surfaces)),
            [&](float /*x*/, float /*y*/, float disparity) { return mapped_px(mapping, disparity); });
  return painting;
}

DepthEnds depth_ends_of(const Painting& painting) {
  if (!painting.surfaces.seen.empty()) return depth_ends(painting.surfaces.seen.front().disparity);
  const std::vector<float> disparities = disparities_of_marks(painting);
  if (disparities.empty()) return {};
  constexpr double outliers_share = 0.005;
  return {percentile(disparities, outliers_share), percentile(disparities, 1 - outliers_share)};
}

Painting place_depth(Painting painting, const DepthPlacing& placing, int width_px) {
  if (placing.regions.empty()) return painting;
  ViewingGeometry viewing = placing.viewing;
  viewing.width_px = width_px;
  const DisparityMapping mapping = disparity_mapping(placing.regions, depth_ends_of(painting), viewing);
  return with_depth(std::move(painting), mapping);
}

float gain_at(const DepthAround& around, float x, float y) {
  const float away_x = x - around.x, away_y = y - around.y;
  const float share = std::exp(-(away_x * away_x + away_y * away_y) / (2 * around.radius_px * around.radius_px));
  return around.gain_elsewhere + share * (around.gain_there - around.gain_elsewhere);
}

float least_radius_px(const DepthAround& around, const DepthEnds& ends) {
  const float deepest_px =
      std::max(std::abs(ends.nearest_px - around.disparity_px), std::abs(ends.farthest_px - around.disparity_px));
  // A Gaussian is steepest at its standard deviation r, 1/(r·√e). What is equally near is then squeezed to 1 − ½ of its
  // width in a view that is one eye separation away.
  constexpr float steepest = 0.60653066f, most_squeezed = 0.5f;
  return steepest * std::abs(around.gain_there - around.gain_elsewhere) * deepest_px / most_squeezed;
}

Painting with_depth_around(Painting painting, const DepthAround& around) {
  DepthAround wide = around;
  wide.radius_px = std::max({around.radius_px, least_radius_px(around, ends_of(painting.surfaces)), 1.f});
  map_depth(painting, std::max(around.gain_there, around.gain_elsewhere), [&](float x, float y, float disparity) {
    return around.disparity_px + gain_at(wide, x, y) * (disparity - around.disparity_px);
  });
  return painting;
}

}  // namespace wheatstone
