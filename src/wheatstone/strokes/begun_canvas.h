#pragma once

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// Strokes that are to be drawn on a canvas, in its pixels. Borrows what hides them.
struct StrokesToDraw {
  Layer layer;
  ViewPosition view;
  Hiding hiding;
  Brush brush;
};

/// The canvas on which a layer begins, as the coarser layers left it: in the size of the layer's pictures, or `factor`
/// times smaller, and with the strokes that are to be drawn on it once it is enlarged. The smaller one is enlarged
/// where its rows are looked at: in a large picture, that saves most of its memory. Border pixels that it left out are
/// bare, and have the colours beside them. Borrows the canvas and the strokes.
struct BegunCanvas {
  const Canvas& canvas;
  int factor = 1;
  int width, height;                       ///< of the layer's pictures
  const StrokesToDraw* strokes = nullptr;  ///< only of a smaller canvas; null: none

  BegunCanvas(const Canvas& own) : canvas(own), width(own.width), height(own.height) {}
  BegunCanvas(const Canvas& smaller, int factor_, int width_, int height_, const StrokesToDraw* strokes_ = nullptr)
      : canvas(smaller), factor(factor_), width(width_), height(height_), strokes(strokes_) {}
};

}  // namespace wheatstone
