#include <algorithm>
#include <array>

#include "wheatstone/drawing/prepared_lines_internal.h"

namespace wheatstone {
namespace {

std::vector<ViewPosition> views_of(const DiffusionPainting& painting) {
  std::vector<ViewPosition> views;
  for (const ColourLine& line : painting.lines)
    if (std::ranges::find(views, line.reference_view) == views.end()) views.push_back(line.reference_view);
  return views;
}

float overhang_at(const ControlPoint& at, const Hiding& hiding) {
  const auto is_seen_at = [&](float offset_px) {
    return !is_hidden(at.x + offset_px, at.y, at.disparity, hiding.reference_view, hiding);
  };
  constexpr std::array offsets_px{0.f, -1.f, 1.f, -2.f, 2.f};
  const auto* const nearest = std::ranges::find_if(offsets_px, is_seen_at);
  return nearest == offsets_px.end() ? 0 : *nearest;
}

}  // namespace

std::vector<float> overhangs_of(const DiffusionPainting& painting, const Surfaces& surfaces) {
  if (surfaces.seen.empty()) return {};
  std::vector<float> overhangs_px(painting.points.size());
  for (const ViewPosition view : views_of(painting)) {
    const SeenSurfaces seen = seen_surfaces(surfaces, view, {painting.width, 0, painting.height});
    for (const ColourLine& line : painting.lines) {
      if (line.reference_view != view) continue;
      for (std::size_t i = line.first_point; i < std::size_t{line.first_point} + line.point_count; ++i)
        overhangs_px[i] = overhang_at(painting.points[i].at, seen.hiding);
    }
  }
  return overhangs_px;
}

}  // namespace wheatstone
