#pragma once

#include <cstdint>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

// Calls `visit(point, reference view)` for the points of all marks.

template <class Visit>
void visit_points(StrokePainting& painting, Visit visit) {
  for (Layer& layer : painting.layers)
    for (const Stroke& stroke : layer.strokes)
      for (std::uint32_t i = 0; i < stroke.point_count; ++i)
        visit(layer.points[stroke.first_point + i], stroke.reference_view);
}

template <class Visit>
void visit_points(RegionPainting& painting, Visit visit) {
  for (const RegionMark& mark : painting.marks)
    for (const Ring& ring : painting.rings_of(mark))
      for (std::uint32_t i = 0; i < ring.point_count; ++i)
        visit(painting.points[ring.first_point + i], mark.reference_view);
}

template <class Visit>
void visit_points(DiffusionPainting& painting, Visit visit) {
  for (const ColourLine& line : painting.lines)
    for (std::uint32_t i = 0; i < line.point_count; ++i)
      visit(painting.points[line.first_point + i].at, line.reference_view);
}

}  // namespace wheatstone
