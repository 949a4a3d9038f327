#pragma once

#include <cstdint>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

// Marks of every kind have a reference view and the views in which they may be drawn, and a kind holds them as `marks`
// with their `points`; only strokes, which are in layers, and lines are called otherwise. A mark names its points by
// the first and their number; only regions have rings between.

/// Calls `visit(mark, holder)` for all strokes, regions or lines; the holder has their points. Of a painting that may
/// or may not be changed.
template <class Painting, class Visit>
void visit_marks(Painting& painting, Visit visit) {
  if constexpr (requires { painting.layers; }) {
    for (auto& layer : painting.layers)
      for (auto& stroke : layer.strokes) visit(stroke, layer);
  } else if constexpr (requires { painting.lines; }) {
    for (auto& line : painting.lines) visit(line, painting);
  } else {
    for (auto& mark : painting.marks) visit(mark, painting);
  }
}

inline ControlPoint& place_of(ControlPoint& point) { return point; }
inline ControlPoint& place_of(ColourPoint& point) { return point.at; }

/// Calls `visit(point, reference view)` for the points of all marks.
template <class Painting, class Visit>
void visit_points(Painting& painting, Visit visit) {
  visit_marks(painting, [&](auto& mark, auto& holder) {
    const auto visit_run = [&](const auto& run) {
      for (std::uint32_t i = 0; i < run.point_count; ++i)
        visit(place_of(holder.points[run.first_point + i]), mark.reference_view);
    };
    if constexpr (requires { holder.rings_of(mark); }) {
      for (const Ring& ring : holder.rings_of(mark)) visit_run(ring);
    } else {
      visit_run(mark);
    }
  });
}

/// Calls `visit(disparity, first point)` for marks that have a disparity beside those of their points. `first point` is
/// a function that gives it.
template <class Painting, class Visit>
void visit_own_disparities(Painting& painting, Visit visit) {
  visit_marks(painting, [&](auto& mark, auto& holder) {
    if constexpr (requires { mark.disparity; })
      visit(mark.disparity, [&]() -> const ControlPoint& {
        if constexpr (requires { holder.rings_of(mark); })
          return holder.points[holder.rings_of(mark).front().first_point];
        else
          return holder.points[mark.first_point];
      });
  });
}

}  // namespace wheatstone
