#include <algorithm>
#include <cmath>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_planner.h"
#include "wheatstone/strokes/strokes_in_time.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {
namespace {

/// The largest radius, halved as often as need be, with which a dot lies on one surface.
float fitting_radius(ImageView<const float> disparity, int x, int y, float radius_px, float depth_threshold_px) {
  constexpr float least_px = 1;
  for (float radius = radius_px; radius > least_px; radius /= 2) {
    const int reach = static_cast<int>(std::ceil(radius));
    bool fits = true;
    for (int row = std::max(y - reach, 0); fits && row <= std::min(y + reach, disparity.height() - 1); ++row)
      for (int column = std::max(x - reach, 0); fits && column <= std::min(x + reach, disparity.width() - 1); ++column)
        fits = std::abs(disparity(column, row) - disparity(x, y)) <= depth_threshold_px;
    if (fits) return radius;
  }
  return least_px;
}

/// Takes the pixels that a dot covers wholly off the mask.
void strike_out(int x, int y, float radius_px, Image<std::uint8_t>& bare) {
  const BrushProfile brush(radius_px);
  const float whole_px = brush.middle_px - brush.rim_px / 2;
  const int reach = std::max(static_cast<int>(whole_px), 0);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, bare.height() - 1); ++row)
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, bare.width() - 1); ++column)
      if (std::hypot(static_cast<float>(column - x), static_cast<float>(row - y)) <= whole_px) bare(column, row) = 0;
  bare(x, y) = 0;
}

}  // namespace

Layer cover_bare(const FilmFrame& frame, const BareView& left_bare, const Style& style, const CarryOptions& options,
                 StrokeMemory& memory) {
  const auto [view, bare] = left_bare;
  const SceneView& scene = frame.views[view];
  const ScaledStyle scaled(style, scene.picture.width());
  TrackedLayer& tracked = memory.views[view].back();
  tracked.layer.radius_px = scaled.radii_px.back();
  Image<std::uint8_t> left(bare.width(), bare.height());
  for (int y = 0; y < bare.height(); ++y) std::ranges::copy(bare.row(y), left.row(y).begin());
  Layer shown{scaled.radii_px.back(), {}, {}};
  for (int y = 0; y < bare.height(); ++y) {
    for (int x = 0; x < bare.width(); ++x) {
      if (left(x, y) == 0) continue;
      const float disparity = scene.disparity(x, y);
      Stroke dot{.first_point = static_cast<std::uint32_t>(tracked.layer.points.size()), .point_count = 1};
      dot.radius_px = fitting_radius(scene.disparity, x, y, scaled.radii_px.back(), scaled.depth_threshold_px);
      dot.opacity = style.opacity;
      dot.colour = scene.picture(x, y);
      dot.disparity = disparity;
      dot.reference_view = scene.position;
      dot.views = {scene.position, scene.position};
      dot.number = ++memory.last_number;
      tracked.layer.points.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, disparity});
      tracked.layer.strokes.push_back(dot);
      tracked.tracks.push_back({.shown = first_shown(frame.flow == nullptr, options)});
      strike_out(x, y, dot.radius_px, left);
      const std::span point = tracked.layer.points_of(dot);
      dot.opacity *= tracked.tracks.back().shown;
      append_visible_runs(dot, point, frame.views, scaled.depth_threshold_px, shown);
    }
  }
  return shown;
}

void insert_strokes(const Layer& part, const Style& style, Layer& whole) {
  append_strokes(part, whole);
  sort_numbered_far_to_near(whole, style.seed);
}

}  // namespace wheatstone
