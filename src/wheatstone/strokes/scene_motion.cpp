#include "wheatstone/strokes/scene_motion_internal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace wheatstone {
namespace {

/// The column nearest to `column` whose disparity is not above `most`; the column itself where there is none.
int column_not_nearer(std::span<const float> disparity, int column, float most) {
  const int width = static_cast<int>(disparity.size());
  for (int distance = 0; distance < width; ++distance) {
    const int left = column - distance, right = column + distance;
    if (left < 0 && right >= width) break;
    const bool left_fits = left >= 0 && disparity[left] <= most;
    const bool right_fits = right < width && disparity[right] <= most;
    // Of two equally close columns, the farther surface is more likely to continue behind the nearer one.
    if (left_fits && right_fits) return disparity[left] <= disparity[right] ? left : right;
    if (left_fits) return left;
    if (right_fits) return right;
  }
  return column;
}

/// A flow's two components at a place, interpolated over those of the four pixels about it that lie on the surface with
/// this disparity; over all where none does.
PointStep step_at(const Flow& flow, ImageView<const float> disparity, const ControlPoint& at,
                  float depth_threshold_px) {
  const int width = disparity.width(), height = disparity.height();
  const float column = std::clamp(at.x - 0.5f, 0.f, static_cast<float>(width - 1));
  const float row = std::clamp(at.y - 0.5f, 0.f, static_cast<float>(height - 1));
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const float across = column - static_cast<float>(left), down = row - static_cast<float>(top);
  float x = 0, y = 0, sum = 0;
  for (int k = 0; k < 4; ++k) {
    const bool right_side = (k & 1) != 0, lower = (k & 2) != 0;
    const int i = std::min(left + (right_side ? 1 : 0), width - 1), j = std::min(top + (lower ? 1 : 0), height - 1);
    if (std::abs(disparity(i, j) - at.disparity) > depth_threshold_px) continue;
    constexpr float least = 1e-3f;  // so that the only pixel of the surface counts however far it is
    const float weight = (right_side ? across : 1 - across) * (lower ? down : 1 - down) + least;
    x += weight * flow.x(i, j);
    y += weight * flow.y(i, j);
    sum += weight;
  }
  if (sum == 0) return {sample(flow.x.view(), at.x, at.y), sample(flow.y.view(), at.x, at.y)};
  return {x / sum, y / sum};
}

}  // namespace

SceneMotion::SceneMotion(const FilmFrame& frame, ImageView<const float> disparity_before, float depth_threshold_px)
    : flow_(*frame.flow),
      disparity_before_(disparity_before),
      reference_(frame.views.front().position),
      depth_threshold_px_(depth_threshold_px) {}

PointStep SceneMotion::of(const ControlPoint& point, ViewPosition view) const {
  float x = x_in_view(point, view, reference_);
  const float y = point.y;
  if (view != reference_) {
    const int row = std::clamp(static_cast<int>(y), 0, disparity_before_.height() - 1);
    const int column = std::clamp(static_cast<int>(x), 0, disparity_before_.width() - 1);
    const int seen = column_not_nearer(disparity_before_.row(row), column, point.disparity + depth_threshold_px_);
    if (seen != column) x = static_cast<float>(seen) + 0.5f;
  }
  const auto [fx, fy, unused] = step_at(flow_.forward, disparity_before_, {x, y, point.disparity}, depth_threshold_px_);
  const float bx = sample(flow_.backward.x.view(), x + fx, y + fy);
  const float by = sample(flow_.backward.y.view(), x + fx, y + fy);
  // Motion edges are not left out, as they are of the mask of confirmed flow: a stroke has its neighbours' word there.
  if (!undo_each_other(fx, fy, bx, by)) return {fx, fy, false};
  return {(fx - bx) / 2, (fy - by) / 2, true};
}

bool SceneMotion::showed_whole(std::span<const ControlPoint> points, float radius_px, ViewPosition view) const {
  const float reach_px = radius_px + depth_edge_px;
  return std::ranges::all_of(points, [&](const ControlPoint& point) {
    const float x = x_in_view(point, view, reference_);
    if (!(x >= 0 && x < static_cast<float>(disparity_before_.width()))) return false;
    const int row = std::clamp(static_cast<int>(point.y), 0, disparity_before_.height() - 1);
    return std::ranges::all_of(std::array{x - reach_px, x, x + reach_px}, [&](float aside) {
      const int column = std::clamp(static_cast<int>(aside), 0, disparity_before_.width() - 1);
      return disparity_before_(column, row) <= point.disparity + depth_threshold_px_;
    });
  });
}

}  // namespace wheatstone
