#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/seen_surface_internal.h"

namespace wheatstone {

PlannedIn kind_of(ViewPosition planned_in, const Surfaces& surfaces) {
  if (surfaces.seen.empty() || planned_in == surfaces.seen.front().view) return PlannedIn::reference_view;
  return photographed_views(surfaces).contains(planned_in) ? PlannedIn::photographed_view : PlannedIn::other_view;
}

SeenSurfaces seen_surfaces(const Surfaces& surfaces, ViewPosition view, const RowsOfView& rows) {
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  SeenSurfaces seen;
  if (surfaces.seen.empty()) return seen;
  seen.reference = Image<float>(rows.width, rows.row_count, unknown);
  seen.photographed = Image<float>(rows.width, rows.row_count);
  seen.nearest = Image<float>(rows.width, rows.row_count);
  const auto see_row = [&](int row, std::vector<float>& continued) {
    const int y = rows.first_row + row;
    const auto reference = seen.reference.row(row), nearest = seen.nearest.row(row),
               photographed = seen.photographed.row(row);
    const auto warp = [&](const Surface& surface, std::span<float> over) {
      if (y >= surface.disparity.height()) return;
      for (const KnownRuns::Run& run : surface.disparity.runs_of(y))
        warp_disparity_row_over(surface.disparity.values_of(run), view - surface.view, surface.left_px + run.begin,
                                over, Landing::edges_and_surfaces);
    };
    warp(surfaces.seen.front(), reference);
    close_cracks(reference);
    std::ranges::copy(reference, photographed.begin());
    continued.assign(nearest.size(), unknown);
    for (const Surface& surface : std::span(surfaces.seen).subspan(1))
      warp(surface, surface.continued ? std::span<float>(continued) : photographed);
    for (std::size_t x = 0; x < nearest.size(); ++x)
      nearest[x] = std::isnan(photographed[x]) ? continued[x] : photographed[x];
  };
  constexpr int rows_at_once = 32;
  tbb::parallel_for(tbb::blocked_range<int>(0, rows.row_count, rows_at_once),
                    [&](const tbb::blocked_range<int>& range) {
                      std::vector<float> continued;
                      for (int row = range.begin(); row < range.end(); ++row) see_row(row, continued);
                    });
  seen.hiding = {seen.nearest,          seen.reference,
                 surfaces.tolerance_px, surfaces.seen.front().view,
                 seen.photographed,     photographed_views(surfaces),
                 rows.first_row};
  return seen;
}

}  // namespace wheatstone
