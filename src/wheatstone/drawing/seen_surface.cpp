#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/seen_surface_internal.h"

namespace wheatstone {

namespace {

/// The number of unknown pixels at the beginning of a row, in whole chunks: most of a surface of another view than the
/// reference.
int unknown_chunks(std::span<const float> row) {
  constexpr std::size_t chunk = 16;
  std::size_t pixels = 0;
  for (; pixels + chunk <= row.size(); pixels += chunk) {
    int known = 0;
    for (std::size_t i = 0; i < chunk; ++i) known |= row[pixels + i] == row[pixels + i] ? 1 : 0;
    if (known != 0) break;
  }
  return static_cast<int>(pixels);
}

PreparedSurfaces::KnownPart known_part(const Surface& surface) {
  PreparedSurfaces::KnownPart known{surface.view, surface.left_px, surface.continued, {}, {}, {}};
  known.disparities.reserve(surface.disparity.pixels().size());  // memory that is not used costs nothing
  for (int y = 0; y < surface.disparity.height(); ++y) {
    known.first_run.push_back(known.runs.size());
    const auto row = surface.disparity.row(y);
    const int width = surface.disparity.width();
    for (int begin = 0; begin < width; ++begin) {
      begin += unknown_chunks(row.subspan(static_cast<std::size_t>(begin)));
      if (begin >= width) break;
      if (std::isnan(row[begin])) continue;
      int end = begin;
      while (end < width && !std::isnan(row[end])) ++end;
      known.runs.push_back({begin, end, known.disparities.size()});
      known.disparities.insert(known.disparities.end(), row.begin() + begin, row.begin() + end);
      begin = end;
    }
  }
  known.first_run.push_back(known.runs.size());
  return known;
}

}  // namespace

PreparedSurfaces::PreparedSurfaces(const Surfaces& surfaces)
    : seen(surfaces.seen.size()), tolerance_px(surfaces.tolerance_px), photographed(photographed_views(surfaces)) {
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) { seen[i] = known_part(surfaces.seen[i]); });
}

PlannedIn kind_of(ViewPosition planned_in, const PreparedSurfaces& surfaces) {
  if (surfaces.seen.empty() || planned_in == surfaces.seen.front().view) return PlannedIn::reference_view;
  return surfaces.photographed.contains(planned_in) ? PlannedIn::photographed_view : PlannedIn::other_view;
}

SeenSurfaces seen_surfaces(const PreparedSurfaces& surfaces, ViewPosition view, const RowsOfView& rows) {
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
    const auto warp = [&](const PreparedSurfaces::KnownPart& part, std::span<float> over) {
      if (y >= part.rows()) return;
      for (const PreparedSurfaces::Run& run : part.runs_of(y))
        warp_disparity_row_over(part.disparities_of(run), view - part.view, part.left_px + run.begin, over,
                                Landing::edges_and_surfaces);
    };
    warp(surfaces.seen.front(), reference);
    close_cracks(reference);
    std::ranges::copy(reference, photographed.begin());
    continued.assign(nearest.size(), unknown);
    for (const PreparedSurfaces::KnownPart& part : std::span(surfaces.seen).subspan(1))
      warp(part, part.continued ? std::span<float>(continued) : photographed);
    for (std::size_t x = 0; x < nearest.size(); ++x)
      nearest[x] = std::isnan(photographed[x]) ? continued[x] : photographed[x];
  };
  constexpr int rows_at_once = 32;
  tbb::parallel_for(tbb::blocked_range<int>(0, rows.row_count, rows_at_once),
                    [&](const tbb::blocked_range<int>& range) {
                      std::vector<float> continued;
                      for (int row = range.begin(); row < range.end(); ++row) see_row(row, continued);
                    });
  seen.hiding = {seen.nearest,      seen.reference,        surfaces.tolerance_px, surfaces.seen.front().view,
                 seen.photographed, surfaces.photographed, rows.first_row};
  return seen;
}

}  // namespace wheatstone
