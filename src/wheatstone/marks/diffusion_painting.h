#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// A point of a line, and the colour that it gives to what lies on its side.
struct ColourPoint {
  ControlPoint at;
  Rgb8 colour;
  friend bool operator==(const ColourPoint&, const ColourPoint&) = default;
};

/// One side of an edge: a line one pixel wide, one pixel away from the edge.
struct ColourLine {
  std::uint32_t first_point = 0;  ///< index into its painting's points
  std::uint32_t point_count = 0;
  ViewPosition reference_view = left_eye;  ///< the view in which its points stand
  ViewRange views;                         ///< in which it may be drawn, where no surface hides it
  friend bool operator==(const ColourLine&, const ColourLine&) = default;
};

/// A painting of edges as a value: colour is given beside them and spreads over the rest.
struct DiffusionPainting {
  static constexpr std::string_view marks_name = "lines";
  int width = 0;  ///< of each view, in pixels
  int height = 0;
  std::vector<ColourPoint> points;
  std::vector<ColourLine> lines;

  std::span<const ColourPoint> points_of(const ColourLine& line) const {
    return {points.data() + line.first_point, line.point_count};
  }
  friend bool operator==(const DiffusionPainting&, const DiffusionPainting&) = default;
};

}  // namespace wheatstone
