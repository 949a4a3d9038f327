#include "wheatstone/strokes/handed_back_internal.h"

namespace wheatstone {
namespace {

void resize_depths_and_radii(float factor, Layer& layer) {
  layer.radius_px *= factor;
  for (Stroke& stroke : layer.strokes) {
    stroke.radius_px *= factor;
    stroke.disparity *= factor;
  }
}

}  // namespace

void hand_back(const ViewFrame& frame, Layer& layer) {
  if (frame == ViewFrame()) return;
  const auto scale = static_cast<float>(frame.scale), origin = static_cast<float>(frame.origin_px);
  for (ControlPoint& point : layer.points) point = {point.x * scale + origin, point.y * scale, point.disparity * scale};
  resize_depths_and_radii(scale, layer);
}

void take_in(const ViewFrame& frame, Layer& layer) {
  if (frame == ViewFrame()) return;
  for (ControlPoint& point : layer.points)
    point = {frame.column(point.x), frame.row(point.y), point.disparity / static_cast<float>(frame.scale)};
  resize_depths_and_radii(1 / static_cast<float>(frame.scale), layer);
}

}  // namespace wheatstone
