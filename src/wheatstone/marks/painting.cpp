#include "wheatstone/marks/painting.h"

#include <cmath>

#include "wheatstone/marks/resize_strokes.h"

namespace wheatstone {
namespace {

ControlPoint times(const ControlPoint& point, float factor) {
  return {point.x * factor, point.y * factor, point.disparity * factor};
}

int times(int length_px, double factor) { return static_cast<int>(std::round(length_px * factor)); }

}  // namespace

Painting resized(Painting painting, double scale) {
  const auto resize = [&](auto& part) {
    part.width = times(part.width, scale);
    part.height = times(part.height, scale);
  };
  const auto factor = static_cast<float>(scale);
  resize(painting.strokes);
  resize(painting.regions);
  resize(painting.curves);
  for (Layer& layer : painting.strokes.layers) resize_strokes(layer, factor);
  for (ControlPoint& point : painting.regions.points) point = times(point, factor);
  for (RegionMark& mark : painting.regions.marks) mark.disparity *= factor;
  for (ColourPoint& point : painting.curves.points) point.at = times(point.at, factor);
  painting.relief.depth_px *= factor;
  painting.relief.bristle_px *= factor;
  return painting;
}

std::vector<float> disparities_of_marks(const Painting& painting) {
  std::vector<float> disparities;
  for (const Layer& layer : painting.strokes.layers)
    for (const Stroke& stroke : layer.strokes) disparities.push_back(stroke.disparity);
  for (const RegionMark& mark : painting.regions.marks) disparities.push_back(mark.disparity);
  for (const ColourPoint& point : painting.curves.points) disparities.push_back(point.at.disparity);
  return disparities;
}

}  // namespace wheatstone
