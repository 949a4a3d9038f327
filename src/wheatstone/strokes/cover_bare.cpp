#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/strokes/cover_bare_internal.h"

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

/// The photograph's colour at a pixel, or where two surfaces' colours mix there, of the nearest pixel of its surface
/// where they do not; its own where none is near.
Rgb8 colour_of_surface(const LayerPlanner& planner, ImageView<const std::uint8_t> mixed_colours, int x, int y,
                       const ScaledStyle& scaled) {
  if (mixed_colours.empty() || mixed_colours(x, y) == 0) return planner.photograph(x, y);
  const int reach = static_cast<int>(std::ceil(scaled.radii_px.back()));
  int nearest = 2 * reach * reach + 1;
  Rgb8 colour = planner.photograph(x, y);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, mixed_colours.height() - 1); ++row) {
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, mixed_colours.width() - 1); ++column) {
      const int distance = (column - x) * (column - x) + (row - y) * (row - y);
      if (distance >= nearest || mixed_colours(column, row) != 0) continue;
      if (std::abs(planner.disparity(column, row) - planner.disparity(x, y)) > scaled.depth_threshold_px) continue;
      nearest = distance;
      colour = planner.photograph(column, row);
    }
  }
  return colour;
}

}  // namespace

Layer strokes_near_bare(const Layer& layer, const Canvas& canvas) {
  constexpr int block_px = 16;
  const int columns = canvas.width / block_px + 1, rows = canvas.height / block_px + 1;
  Image<std::uint8_t> has_bare(columns, rows);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      if (canvas.coverage(x, y) < 0.5f) has_bare(x / block_px, y / block_px) = 1;
  const auto block = [](float place, int count) {
    return std::clamp(static_cast<int>(std::floor(place / block_px)), 0, count - 1);
  };
  const auto may_cover = [&](const Stroke& stroke) {
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    const auto [left, right] = std::ranges::minmax_element(points, {}, &ControlPoint::x);
    const auto [top, bottom] = std::ranges::minmax_element(points, {}, &ControlPoint::y);
    const float reach = stroke.radius_px + 1;
    for (int row = block(top->y - reach, rows); row <= block(bottom->y + reach, rows); ++row)
      for (int column = block(left->x - reach, columns); column <= block(right->x + reach, columns); ++column)
        if (has_bare(column, row) != 0) return true;
    return false;
  };
  Layer near{layer.radius_px, layer.points, {}};
  std::ranges::copy_if(layer.strokes, std::back_inserter(near.strokes), may_cover);
  return near;
}

Layer cover_bare(const LayerPlanner& planner, const LayerInputs& inputs, const ScaledStyle& scaled, const Style& style,
                 ImageView<const std::uint8_t> wanted) {
  const int width = planner.photograph.width(), height = planner.photograph.height();
  Image<std::uint8_t> bare(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      bare(x, y) = planner.canvas.coverage(x, y) < 0.5f && (wanted.empty() || wanted(x, y) != 0) ? 255 : 0;
  Layer dots{scaled.radii_px.back(), {}, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (bare(x, y) == 0) continue;
      const float disparity = planner.disparity(x, y);
      Stroke dot{.first_point = static_cast<std::uint32_t>(dots.points.size()), .point_count = 1};
      dot.radius_px = fitting_radius(planner.disparity, x, y, scaled.radii_px.back(), scaled.depth_threshold_px);
      dot.opacity = style.opacity;
      dot.colour = colour_of_surface(planner, inputs.mixed_colours, x, y, scaled);
      dot.disparity = disparity;
      dot.reference_view = planner.view;
      dot.views = all_views;
      dots.points.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, disparity});
      dots.strokes.push_back(dot);
      strike_out(x, y, dot.radius_px, bare);
    }
  }
  return dots;
}

}  // namespace wheatstone
