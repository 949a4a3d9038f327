#include "wheatstone/strokes/visible_runs_internal.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/motion/flow.h"

namespace wheatstone {
float surface_disparity(ImageView<const float> disparity, float x, float y, float depth_threshold_px) {
  const auto width = static_cast<float>(disparity.width()), height = static_cast<float>(disparity.height());
  const float column = std::clamp(x - 0.5f, 0.f, width - 1), row = std::clamp(y - 0.5f, 0.f, height - 1);
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const int right = std::min(left + 1, disparity.width() - 1), bottom = std::min(top + 1, disparity.height() - 1);
  const float a = disparity(left, top), b = disparity(right, top), c = disparity(left, bottom),
              d = disparity(right, bottom);
  const float across = column - static_cast<float>(left), down = row - static_cast<float>(top);
  const auto [least, most] = std::minmax({a, b, c, d});
  if (most - least > depth_threshold_px)  // several surfaces: that of the pixel
    return disparity(across < 0.5f ? left : right, down < 0.5f ? top : bottom);
  return sample(disparity, x, y);
}

bool is_visible(const ControlPoint& point, ViewPosition from, const View& view, float tolerance_px) {
  return disparity_at(view, x_in_view(point, from, view.position), point.y) <= point.disparity + tolerance_px;
}

void append_everywhere(Stroke stroke, std::span<const ControlPoint> points, Layer& layer) {
  stroke.first_point = static_cast<std::uint32_t>(layer.points.size());
  stroke.views = all_views;
  layer.points.insert(layer.points.end(), points.begin(), points.end());
  layer.strokes.push_back(stroke);
}

}  // namespace wheatstone
