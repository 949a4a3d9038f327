#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <utility>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/seen_surface_internal.h"

namespace wheatstone {

PreparedSurfaces::PreparedSurfaces(Surfaces of_painting) : surfaces(std::move(of_painting)) {
  for (const Surface& surface : surfaces.seen) {
    std::vector<Run>& known = runs.emplace_back();
    std::vector<std::size_t>& first = first_run.emplace_back();
    for (int y = 0; y < surface.disparity.height(); ++y) {
      first.push_back(known.size());
      const auto row = surface.disparity.row(y);
      const int width = surface.disparity.width();
      for (int begin = 0; begin < width; ++begin) {
        if (std::isnan(row[begin])) continue;
        int end = begin;
        while (end < width && !std::isnan(row[end])) ++end;
        known.push_back({begin, end});
        begin = end;
      }
    }
    first.push_back(known.size());
  }
}

SeenSurfaces seen_surfaces(const PreparedSurfaces& prepared, ViewPosition view, int width, int height) {
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  SeenSurfaces seen;
  const Surfaces& surfaces = prepared.surfaces;
  if (surfaces.seen.empty()) return seen;
  seen.reference = Image<float>(width, height, unknown);
  seen.nearest = seen.photographed = Image<float>(width, height, unknown);
  tbb::parallel_for(0, height, [&](int y) {
    const auto reference = seen.reference.row(y), nearest = seen.nearest.row(y),
               photographed = seen.photographed.row(y);
    const auto warp = [&](std::size_t i, std::span<float> over) {
      const Surface& surface = surfaces.seen[i];
      if (y >= surface.disparity.height()) return;
      for (const auto& [begin, end] : prepared.runs_of(i, y))
        warp_disparity_row_over(surface.disparity.row(y).subspan(begin, end - begin), view - surface.view,
                                surface.left_px + begin, over);
    };
    warp(0, reference);
    close_cracks(reference);
    std::ranges::copy(reference, photographed.begin());
    std::vector<float> continued(nearest.size(), unknown);
    for (std::size_t i = 1; i < surfaces.seen.size(); ++i)
      warp(i, surfaces.seen[i].continued ? std::span<float>(continued) : photographed);
    for (std::size_t x = 0; x < nearest.size(); ++x)
      nearest[x] = std::isnan(photographed[x]) ? continued[x] : photographed[x];
  });
  seen.hiding = {seen.nearest,          seen.reference,
                 surfaces.tolerance_px, surfaces.seen.front().view,
                 seen.photographed,     photographed_views(surfaces)};
  return seen;
}

}  // namespace wheatstone
