#pragma once

#include <span>

#include "wheatstone/display/compose.h"
#include "wheatstone/drawing/draw.h"

namespace wheatstone {

/// Views of a painting as the one picture that a display takes.
struct ComposedViews {
  Image<Rgb8> picture;
  double worst_bare_share = 0;  ///< of a view's pixels that marks cover less than half
};

/// Draws views and composes them. A graphics processor that draws them composes them, too, in its own memory, and under
/// lenses draws of strokes only the pixels of which the screen shows anything (Hassaine 2010, sec. 6.5.2); the share of
/// bare ones is then of these. Of a quilt that the processor draws, only a few views are in memory beside it. Throws as
/// `draw` and `compose` do.
ComposedViews draw_composed(const PreparedPainting& painting, std::span<const ViewPosition> views,
                            const DisplayComposition& composition);

}  // namespace wheatstone
