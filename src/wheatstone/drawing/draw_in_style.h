#pragma once

#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Draws the finished strokes for one view, over what the style wants behind them, lit where it wants texture.
DrawnView draw_in_style(ImageView<const Rgb8> photograph, const StrokePainting& painting, ViewPosition view,
                        const Style& style);

}  // namespace wheatstone
