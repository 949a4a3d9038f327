#pragma once

#include <span>
#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A painting of two eyes that can be seen from any view between and beyond them: with strokes for what comes into
/// sight there, and with the surfaces that hide strokes.
struct WidePainting {
  StrokePainting painting;
  ViewRange views;                               ///< in which it has paint everywhere
  Image<float> left_disparity, right_disparity;  ///< of the scene, in the eyes' geometries
  StereoPair behind;                             ///< photographs that show through thin paint; empty: canvas does
};

/// Adds to a planned painting what the outermost views uncover and no photograph shows: the farther surface beside an
/// uncovered part goes on there, with its colours mirrored; strokes are planned on it as on what one eye alone sees
/// (Stavrakis & Gelautz 2005, sec. 3.2). What one outermost view uncovers contains what the views on its side do.
/// `style` is that of the painting, whose strokes were propagated. Throws Error{wrong_usage} otherwise.
WidePainting widen(StrokePainting painting, const StereoPair& photographs, const StereoGeometry& geometry,
                   const Style& style, ViewRange views);

/// Draws a view. A stroke is drawn where none of the scene's surfaces hides its points from there. The few pixels that
/// no stroke covers, which are counted and told, take the colour of the farther of the painted pixels beside them.
DrawnView draw(const WidePainting& wide, ViewPosition view, bool with_disparity = false);

/// Draws many views for little more than a few: strokes are drawn for the eyes and the outermost views, and what is
/// seen of each stroke there is moved to the views between by its disparity (as the fragments of splats are, Hassaine
/// 2010, sec. 4.5). Positions must lie within the painting's views; one picture for each, in their order.
std::vector<DrawnView> draw_views(const WidePainting& wide, std::span<const ViewPosition> positions);

}  // namespace wheatstone
