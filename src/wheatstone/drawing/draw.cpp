#include "wheatstone/drawing/draw.h"

#include "wheatstone/drawing/relief.h"

namespace wheatstone {

DrawnView draw(const Painting& painting, ViewPosition view) {
  if (painting.regions.width > 0) return draw(painting.regions, view);
  if (painting.curves.width > 0) return draw(painting.curves, view);
  DrawnView drawn = draw(painting.strokes, view);
  light_paint(painting.strokes, view, painting.relief, drawn.picture);
  return drawn;
}

}  // namespace wheatstone
