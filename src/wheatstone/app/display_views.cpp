#include "wheatstone/app/display_views.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/depth/rig.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

void check_has_surfaces(const Painting& painting) {
  if (painting.surfaces.seen.empty())
    throw Error(ErrorKind::bad_input,
                "the painting has no surfaces, which other views than those of two eyes need; paint its photographs "
                "again, with strokes that are propagated");
}

/// Eye separations between the outermost views, with which the depth takes at most `depth_share` of a view's width.
float span_for(const DisplayViewsOptions& options, const DepthEnds& ends, float scale) {
  if (options.span > 0) return options.span;
  const float depth_px = std::max((ends.nearest_px - ends.farthest_px) * scale, 1.f);
  return std::min(options.depth_share * static_cast<float>(options.width) / depth_px, options.widest_span);
}

/// Both eyes' pictures, moved against each other so that the screen plane has no parallax, share a part of the width,
/// which fills a view.
Placement placement_for(PictureSize painting, const DisplayViewsOptions& options, float zero_parallax_px) {
  const auto [width, height] = painting;
  const double shared = shared_width(width, zero_parallax_px);
  const ShownPart part = shown_part(shared, height, options.width, options.height, options.framing);
  Placement placement{.width = options.width, .height = options.height, .zero_parallax_px = zero_parallax_px};
  placement.scale = part.scale;
  placement.left = (width - shared) / 2 + part.left;
  placement.top = part.top;
  return placement;
}

/// The place in each view of the part that both eyes show.
CoveredPart covered_by(PictureSize painting, const Placement& placement) {
  const double shared = shared_width(painting.width, placement.zero_parallax_px);
  return covered_part(
      shared, painting.height, placement.width, placement.height,
      {.left = placement.left - (painting.width - shared) / 2, .top = placement.top, .scale = placement.scale});
}

/// The rest of the pictures is black.
void put_bars(const DisplayPlan& plan, Presented& shown) {
  const Placement& placement = plan.presentation.placement;
  const CoveredPart& covered = plan.covered;
  if (covered.left == 0 && covered.top == 0 && covered.right == placement.width && covered.bottom == placement.height)
    return;
  for (Image<Rgb8>& view : shown.views) put_bars(covered, view);
  if (shown.composed.empty()) return;
  const auto* const quilt = std::get_if<QuiltLayout>(&*plan.presentation.composition);
  const int columns = quilt != nullptr ? quilt->columns : 1, rows = quilt != nullptr ? quilt->rows : 1;
  const int width = shown.composed.width() / columns, height = shown.composed.height() / rows;
  const auto scaled = [](int place, int of, int to) { return place * to / of; };
  const CoveredPart part{scaled(covered.left, placement.width, width), scaled(covered.top, placement.height, height),
                         scaled(covered.right, placement.width, width),
                         scaled(covered.bottom, placement.height, height)};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      put_bars(part, ImageView<Rgb8>(&shown.composed(column * width, row * height), width, height,
                                     shown.composed.view().stride()));
}

/// A view shows a part of the painting, which is as wide as the screen.
Painting with_placed_depth(const Painting& painting, const DisplayViewsOptions& options) {
  const Placement placement = placement_for({width_of(painting), height_of(painting)}, options, 0);
  return place_depth(painting, options.depth, static_cast<int>(std::lround(options.width / placement.scale)));
}

/// Placed depth is final: the screen plane is at disparity 0.
DisplayViewsOptions for_placed(DisplayViewsOptions options) {
  options.depth = {};
  options.zero_parallax_px = 0;
  if (options.span == 0) options.span = options.widest_span;
  return options;
}

}  // namespace

DisplayViewsOptions views_of_display(const DisplayPreset& display) {
  return {.views = display.views,
          .width = display.view_width_px,
          .height = display.view_height_px,
          .widest_span = std::max(span_of(display), 1.f)};
}

DisplayPlan plan_display(PictureSize painting, const DepthEnds& ends, const DisplayViewsOptions& options) {
  check_number("views", options.views, view_count_range);
  check_number("span", options.span, view_span_range);
  DisplayPlan plan;
  plan.zero_parallax_px = options.zero_parallax_px.value_or(ends.middle_px());
  const Placement placement = placement_for(painting, options, plan.zero_parallax_px);
  plan.span = span_for(options, ends, static_cast<float>(placement.scale));
  plan.presentation = {.views = evenly_spaced(options.width, options.height, options.views, plan.span).positions,
                       .placement = placement,
                       .device = options.device};
  plan.covered = covered_by(painting, placement);
  return plan;
}

DisplayViews draw_display_views(const Painting& painting, const DisplayViewsOptions& options, const Progress& progress,
                                const std::optional<DisplayComposition>& composition) {
  check_has_surfaces(painting);
  if (!options.depth.regions.empty())
    return draw_display_views(with_placed_depth(painting, options), for_placed(options), progress, composition);
  DisplayViews result;
  result.plan = plan_display({width_of(painting), height_of(painting)},
                             depth_ends(painting.surfaces.seen.front().disparity), options);
  result.plan.presentation.composition = composition;
  if (!composition) check_views_fit({options.width, options.height, result.plan.presentation.views});
  report(progress, "views", 0);
  result.shown = present(painting, result.plan.presentation);
  put_bars(result.plan, result.shown);
  report(progress, "views", 1);
  return result;
}

}  // namespace wheatstone
