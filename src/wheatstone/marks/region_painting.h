#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// A closed polygon: at least three points, the last joined to the first.
struct Ring {
  std::uint32_t first_point = 0;  ///< index into its painting's points
  std::uint32_t point_count = 0;
  friend bool operator==(const Ring&, const Ring&) = default;
};

/// A region of one colour on one surface, between its outer ring and the rings of its holes (even-odd rule). Each point
/// carries the disparity of the region's own surface at that point.
struct RegionMark {
  std::uint32_t first_ring = 0;  ///< index into its painting's rings
  std::uint32_t ring_count = 0;
  Rgb8 colour;
  float disparity = 0;                     ///< the mark's depth: its mean
  ViewPosition reference_view = left_eye;  ///< the view in which its points stand
  ViewRange views;                         ///< in which it may be drawn, where no surface hides it
  friend bool operator==(const RegionMark&, const RegionMark&) = default;
};

/// A painting of regions as a value: planned once, drawn for any view. Marks lie in drawing order: first those that
/// only one eye sees, then the others, each far to near.
struct RegionPainting {
  static constexpr std::string_view marks_name = "regions";
  int width = 0;  ///< of each view, in pixels
  int height = 0;
  std::vector<ControlPoint> points;
  std::vector<Ring> rings;
  std::vector<RegionMark> marks;

  std::span<const Ring> rings_of(const RegionMark& mark) const {
    return {rings.data() + mark.first_ring, mark.ring_count};
  }
  std::span<const ControlPoint> points_of(const Ring& ring) const {
    return {points.data() + ring.first_point, ring.point_count};
  }
  friend bool operator==(const RegionPainting&, const RegionPainting&) = default;
};

}  // namespace wheatstone
