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

// Calls `visit(mark)` for all strokes, regions or lines; of a painting that may or may not be changed.

template <class Painting, class Visit>
void visit_marks(Painting& painting, Visit visit) {
  if constexpr (requires { painting.layers; }) {
    for (auto& layer : painting.layers)
      for (auto& stroke : layer.strokes) visit(stroke);
  } else if constexpr (requires { painting.lines; }) {
    for (auto& line : painting.lines) visit(line);
  } else {
    for (auto& mark : painting.marks) visit(mark);
  }
}

}  // namespace wheatstone
