#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "wheatstone/strokes/outline_disparity.h"

namespace wheatstone {
namespace {

/// Part of a row that paint covers: around a column, half its width to either side.
struct PaintInRow {
  std::span<const float> disparity;  ///< of the row
  int column;
  float half_width_px;

  float at(int away) const { return disparity[std::clamp(column + away, 0, static_cast<int>(disparity.size()) - 1)]; }
};

/// One side of the paint, where outlines matter to views so many eye separations to the other side.
struct OutlineSide {
  int step;  ///< −1 or 1
  float views;

  /// Outlines farther away leave a disparity as it is.
  int farthest(const PaintInRow& paint, float depth_threshold_px) const {
    return static_cast<int>(paint.half_width_px + views * depth_threshold_px) + 1;
  }
};

/// Whether the row's surface continues over the range in which outlines matter, as it does nearly everywhere.
bool goes_on(const PaintInRow& paint, const OutlineSide& side, float own, float depth_threshold_px) {
  const int farthest = side.farthest(paint, depth_threshold_px);
  const auto is_own = [&](int away) { return std::abs(paint.at(side.step * away) - own) <= depth_threshold_px; };
  return side.views <= 0 || (is_own(farthest) && is_own((farthest + 1) / 2));
}

/// The largest disparity where the row's surface ends on one side. If the outline is s away, paint that reaches w may
/// move no farther than the outline plus the distance that is left: v·d ≤ v·d_outline + s − w.
float most_beside(const PaintInRow& paint, const OutlineSide& side, float own, float depth_threshold_px) {
  if (side.views <= 0) return own;
  const int farthest = side.farthest(paint, depth_threshold_px);
  for (int away = 0; away < farthest; ++away) {
    const float here = paint.at(side.step * away), change = paint.at(side.step * (away + 1)) - here;
    if (change > depth_threshold_px) return own;  // something nearer hides the outline
    if (change >= -depth_threshold_px) continue;
    if (std::abs(here - own) > depth_threshold_px) return own;
    // The outline is half a pixel beyond the middle of the last pixel.
    const float outline = here - std::clamp(paint.at(side.step * (away - 1)) - here, 0.f, 1.f) / 2;
    const float rest_px = static_cast<float>(away) + 0.5f - paint.half_width_px;
    // A mark that lies far behind its surface would be hidden by it.
    return std::clamp(outline + std::max(rest_px, 0.f) / side.views, own - depth_threshold_px / 2, own);
  }
  return own;
}

}  // namespace

float disparity_within_outline(const StrokeGround& ground, const ControlPoint& point, float radius_px) {
  const int column = static_cast<int>(point.x), middle_row = static_cast<int>(point.y);
  if (!ground.disparity.contains(column, middle_row)) return point.disparity;
  const std::array sides{OutlineSide{-1, ground.beside.right}, OutlineSide{1, ground.beside.left}};
  const auto is_inside = [&](const OutlineSide& side) {
    return goes_on({ground.disparity.row(middle_row), column, radius_px}, side, point.disparity,
                   ground.depth_threshold_px);
  };
  if (std::ranges::all_of(sides, is_inside)) return point.disparity;
  // Three rows of the round brush are enough: outlines that are less steep move along themselves.
  constexpr float aslant = 0.7071f;
  float most = point.disparity;
  for (const float row_px : {0.f, -aslant * radius_px, aslant * radius_px}) {
    const int row = static_cast<int>(std::floor(point.y + row_px));
    if (!ground.disparity.contains(column, row)) continue;
    if (std::abs(ground.disparity(column, row) - point.disparity) > ground.depth_threshold_px) continue;
    const PaintInRow paint{ground.disparity.row(row), column, row_px == 0 ? radius_px : aslant * radius_px};
    for (const OutlineSide& side : sides)
      most = std::min(most, most_beside(paint, side, point.disparity, ground.depth_threshold_px));
  }
  return most;
}

}  // namespace wheatstone
