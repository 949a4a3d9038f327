#include "wheatstone/marks/resize_strokes.h"

namespace wheatstone {

void resize_strokes(Layer& layer, float factor) {
  layer.radius_px *= factor;
  for (ControlPoint& point : layer.points) point = {point.x * factor, point.y * factor, point.disparity * factor};
  for (Stroke& stroke : layer.strokes) {
    stroke.radius_px *= factor;
    stroke.disparity *= factor;
  }
}

}  // namespace wheatstone
