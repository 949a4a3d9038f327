#pragma once

#include <hwy/cache_control.h>

#include <cstdint>
#include <vector>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// A stroke as the rasteriser wants it: a chain of straight segments.
struct FlatStroke {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;  ///< one for a dot
  float radius_px = 0;
  float opacity = 1;
  float red = 0, green = 0, blue = 0;                       ///< 0..255, where it begins
  float red_change = 0, green_change = 0, blue_change = 0;  ///< from there to its end
  float length = 0;                                         ///< of its chain in the central view, in pixels
  float farthest_disparity = 0, nearest_disparity = 0;      ///< of its points
  float top = 0, bottom = 0;                                ///< the rows its chain spans, without the radius
  float left = 0, right = 0;                                ///< the columns, in the central view
  float disparity = 0, depth_slope = 0;  ///< disparity + depth_slope · y is about that of all of its points
  bool is_rigid = false;                 ///< … so nearly that the views see its rows shifted
  ViewRange views;
  std::uint32_t number = 0;
  std::uint32_t seed = 0;  ///< of its bristles
  ViewPosition reference_view;

  friend bool operator==(const FlatStroke&, const FlatStroke&) = default;
  bool changes_colour() const { return red_change != 0 || green_change != 0 || blue_change != 0; }
};

/// The strokes of one layer, in drawing order, for any view; vertices as a structure of arrays. A vertex at x in the
/// central view stands at x − v · disparity in the view at v.
struct FlatLayer {
  static constexpr std::size_t values_after =
      2 * std::size_t{Canvas::widest_vector};  ///< behind the last vertex, so that whole vectors load
  std::vector<float> x, y, disparity;
  std::vector<float> along;  ///< length of the stroke's chain up to the vertex, in the central view
  std::vector<FlatStroke> strokes;

  // Neighbouring strokes lie far apart in memory, so they are prefetched this many strokes ahead.
  static constexpr std::size_t strokes_ahead = 20, vertices_ahead = 10;

  // Always inline and without a loop, because GCC removes calls and loops that only prefetch.
  HWY_INLINE void ask_for_stroke(std::size_t stroke) const {
    hwy::Prefetch(&strokes[stroke]);
    hwy::Prefetch(&strokes[stroke].disparity);
  }
  HWY_INLINE void ask_for_vertices(std::size_t stroke) const {
    const std::size_t first = strokes[stroke].first_vertex, last = first + strokes[stroke].vertex_count;
    hwy::Prefetch(x.data() + first);
    hwy::Prefetch(x.data() + last);
    hwy::Prefetch(y.data() + first);
    hwy::Prefetch(y.data() + last);
    hwy::Prefetch(disparity.data() + first);
    hwy::Prefetch(disparity.data() + last);
  }
};

/// Bends every stroke's cubic B-spline (clamped: it begins and ends at its outer control points) into segments that
/// leave the curve by less than an eighth of the brush's rim in any view from eye to eye.
FlatLayer flatten(const Layer& layer);

/// A flat layer as one view sees it, in columns that are counted from `left_px`.
struct SeenLayer {
  SeenLayer(const FlatLayer& layer, ViewPosition view, float left = 0)
      : flat(layer), shift(view - central_view), left_px(left) {}
  float x(std::size_t vertex) const { return flat.x[vertex] - shift * flat.disparity[vertex] - left_px; }

  const FlatLayer& flat;
  float shift, left_px;
};

}  // namespace wheatstone
