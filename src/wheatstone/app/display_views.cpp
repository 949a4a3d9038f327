#include "wheatstone/app/display_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/stereo/outer_view.h"

namespace wheatstone {

void check_has_surfaces(const Surfaces& surfaces) {
  if (surfaces.seen.empty())
    throw Error(ErrorKind::bad_input,
                "the painting has no surfaces, which other views than those of two eyes need; paint its photographs "
                "again, with strokes that are propagated");
}

namespace {

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
  const CoveredPart covered = covered_by(painting, placement);
  if (covered != CoveredPart{0, 0, placement.width, placement.height}) plan.presentation.covered = covered;
  return plan;
}

DisplayViews draw_display_views(const Painting& painting, const DisplayViewsOptions& options, const Progress& progress,
                                const std::optional<DisplayComposition>& composition) {
  check_has_surfaces(painting.surfaces);
  if (!options.depth.regions.empty())
    return draw_display_views(with_placed_depth(painting, options), for_placed(options), progress, composition);
  DisplayViews result;
  result.plan = plan_display({width_of(painting), height_of(painting)},
                             depth_ends(painting.surfaces.seen.front().disparity), options);
  result.plan.presentation.composition = composition;
  if (!composition) check_views_fit({options.width, options.height, result.plan.presentation.views});
  report(progress, "views", 0);
  result.shown = present(painting, result.plan.presentation);
  report(progress, "views", 1);
  return result;
}

namespace {

/// The disparity with smooth outlines, and with near things a little larger. Around their edges the camera mixed the
/// colours of two surfaces, and a map is not exact. Pixels that stay behind when a near thing is moved show as specks;
/// pixels that move with it do not.
Image<float> with_edges_near(ImageView<const float> disparity) {
  constexpr int px_a_margin = 400, widest_px = 4;
  constexpr float step_px = 2;
  const int margin = std::clamp(disparity.width() / px_a_margin, 1, widest_px);
  constexpr int smooth_px = 5;
  Image<float> even(disparity.width(), disparity.height()), near(disparity.width(), disparity.height());
  cv::medianBlur(as_mat(disparity), as_mat(even), smooth_px);
  cv::dilate(as_mat(even), as_mat(near),
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * margin + 1, 2 * margin + 1)));
  for (int y = 0; y < near.height(); ++y)
    for (int x = 0; x < near.width(); ++x)
      if (!(near(x, y) > even(x, y) + step_px)) near(x, y) = even(x, y);
  return near;
}

/// Smooths the parts that no photograph shows. They are continued row by row, each row from its own place, and the
/// median of the colours around is calmer.
void calm_unseen(ImageView<const std::uint8_t> unseen, Image<Rgb8>& picture) {
  constexpr int around_px = 5;
  cv::Mat calm, around;
  cv::medianBlur(as_mat(picture), calm, around_px);
  cv::dilate(as_mat(unseen), around, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(around_px, around_px)));
  calm.copyTo(as_mat(picture), around);
}

}  // namespace

std::vector<Image<Rgb8>> draw_photograph_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                               const DisplayViewsOptions& options, double stretch,
                                               const Progress& progress) {
  const int width = photographs.left.width(), height = photographs.left.height();
  const DisplayPlan plan = plan_display({width, height}, depth_ends(geometry.left_disparity), options);
  check_views_fit({options.width, options.height, plan.presentation.views});
  const Image<float> left = with_edges_near(geometry.left_disparity), right = with_edges_near(geometry.right_disparity);
  const std::array<View, 2> eyes{
      View{.colour = photographs.left, .disparity = left, .wanted = {}, .position = left_eye},
      View{.colour = photographs.right, .disparity = right, .wanted = {}, .position = right_eye}};
  // The part of the screen plane that both eyes show fills the frame.
  const double shared = shared_width(width, plan.zero_parallax_px);
  ShownPart part = shown_part(shared, height, options.width, options.height, options.framing, stretch);
  const CoveredPart covered = covered_part(shared, height, options.width, options.height, part);
  std::vector<Image<Rgb8>> views;
  for (const ViewPosition position : plan.presentation.views) {
    report(progress, "views", static_cast<double>(views.size()) / static_cast<double>(plan.presentation.views.size()));
    const View view = make_outer_view(eyes, position, plan.zero_parallax_px);
    // Its pictures begin at a whole pixel; the display's do not.
    const double moved = -(position - central_view) * plan.zero_parallax_px - static_cast<float>(view.frame.origin_px);
    ShownPart of_view = part;
    of_view.left = part.left + (width - shared) / 2 + moved;
    Image<Rgb8> picture = copy_of(view.colour);
    calm_unseen(view.wanted, picture);
    views.push_back(framed_view(picture, options.width, options.height, of_view));
    put_bars(covered, views.back());
  }
  return views;
}

}  // namespace wheatstone
