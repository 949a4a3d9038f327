#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/painting/painting.h"
#include "wheatstone/painting/rasterise.h"
#include "wheatstone/painting/style.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// A point of a line, and the colour that it gives to what lies on its side.
struct ColourPoint {
  ControlPoint at;
  Rgb8 colour;
  friend bool operator==(const ColourPoint&, const ColourPoint&) = default;
};

/// One side of an edge: a line a pixel wide, a pixel beside it.
struct ColourLine {
  std::uint32_t first_point = 0;  ///< index into its painting's points
  std::uint32_t point_count = 0;
  float reference_view = left_eye;  ///< the view in which its points stand
  ViewRange views;
  friend bool operator==(const ColourLine&, const ColourLine&) = default;
};

/// A painting of edges as a value: colour is given beside them and spreads over the rest.
struct DiffusionPainting {
  int width = 0;  ///< of each view, in pixels
  int height = 0;
  std::vector<ColourPoint> points;
  std::vector<ColourLine> lines;

  std::span<const ColourPoint> points_of(const ColourLine& line) const {
    return {points.data() + line.first_point, line.point_count};
  }
  friend bool operator==(const DiffusionPainting&, const DiffusionPainting&) = default;
};

/// The edges of a scene as diffusion curves (Orzan et al. 2013), as dual strokes with a radius and an offset of a pixel
/// (Bukenberger et al. 2015, sec. 4.2). All views show the lines of the reference view, the first, but for those on the
/// side of a view where something hides them: where a view's disparity, at the place that a point goes to, is larger by
/// more than the depth threshold. Where a surface goes behind another, the line on the farther side belongs to the view
/// that sees it there; what the reference view does not show has lines of its own. With Propagation::independent each
/// view is planned alone. Throws Error: bad_input where pictures, disparities and masks do not fit together or a
/// disparity is unknown, wrong_usage for a style that cannot be painted with.
DiffusionPainting plan_diffusion(std::span<const SceneView> views, const Style& style);

/// The same of a pair, with the left eye as reference view.
DiffusionPainting plan_diffusion(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style);

/// Draws the lines for one view, every point moved by its own disparity, and lets the colours between them settle: the
/// Laplace equation, begun by pull and push over a pyramid. The same bytes on any number of threads. Only a painting
/// without lines is bare; it is grey.
DrawnView draw(const DiffusionPainting& painting, float view);

}  // namespace wheatstone
