#include "wheatstone/strokes/visible_runs_internal.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/motion/flow.h"

namespace wheatstone {
namespace {

/// A bit for each of the scene's views that shows the point.
unsigned views_of(const ControlPoint& point, ViewPosition reference, std::span<const SceneView> views,
                  float tolerance_px) {
  unsigned seen = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
    if (is_visible(point, reference, views[i], tolerance_px)) seen |= 1u << i;
  return seen;
}

/// From the first to the last of the views.
ViewRange range_of(unsigned seen, std::span<const SceneView> views) {
  if (seen + 1 == 1u << views.size()) return {};
  ViewRange range{right_eye, left_eye};
  for (std::size_t i = 0; i < views.size(); ++i) {
    if ((seen >> i & 1) == 0) continue;
    range.first = std::min(range.first, views[i].position);
    range.last = std::max(range.last, views[i].position);
  }
  return range;
}

}  // namespace

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

bool is_visible(const ControlPoint& point, ViewPosition reference, const SceneView& view, float tolerance_px) {
  const float x = x_in_view(point, reference, view.position);
  const int column = std::clamp(static_cast<int>(x), 0, view.disparity.width() - 1);
  const int row = std::clamp(static_cast<int>(point.y), 0, view.disparity.height() - 1);
  return view.disparity(column, row) <= point.disparity + tolerance_px;
}

void append_visible_runs(const Stroke& stroke, std::span<const ControlPoint> points, std::span<const SceneView> views,
                         float tolerance_px, Layer& shown) {
  const auto first = static_cast<std::uint32_t>(shown.points.size());
  shown.points.insert(shown.points.end(), points.begin(), points.end());
  Stroke run = stroke;
  if (views.size() == 1) {
    run.first_point = first;
    run.views = {};
    shown.strokes.push_back(run);
    return;
  }
  const auto seen_from = [&](std::size_t i) { return views_of(points[i], stroke.reference_view, views, tolerance_px); };
  unsigned seen = seen_from(0);
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    unsigned next = seen;
    while (end < points.size() && (next = seen_from(end)) == seen) ++end;
    if (seen != 0) {
      run.first_point = first + static_cast<std::uint32_t>(begin);
      run.point_count = static_cast<std::uint32_t>(end - begin);
      run.views = range_of(seen, views);
      shown.strokes.push_back(run);
    }
    begin = end;
    seen = next;
  }
}

}  // namespace wheatstone
