#include "wheatstone/painting/paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/drawing/relief.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/painting/naive_planning_internal.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/warp.h"
#include "wheatstone/stopwatch.h"
#include "wheatstone/strokes/occluded_part.h"

namespace wheatstone {
namespace {

bool is_raster(const Style& style) { return style.propagation == Propagation::raster && is_of_strokes(style); }

/// Draws a planned painting for both eyes, and for nearer eyes, which have no photograph as background.
void draw_views(const StereoPairView& photographs, const Style& style, const PaintDrawing& drawing,
                PaintedPair& result) {
  result.separation = comfortable_separation(result.painting, drawing.depth_budget);
  Presentation presentation = for_own_and_nearer_eyes(result.separation);
  presentation.device = drawing.device;
  if (style.background == Background::photograph) {
    presentation.backgrounds = {photographs.left, photographs.right};
    presentation.backgrounds.resize(presentation.views.size());
  }
  Presented shown = present(result.painting, presentation);
  result.pictures = {std::move(shown.views[0]), std::move(shown.views[1])};
  result.left_bare_share = shown.bare_shares[0];
  result.right_bare_share = shown.bare_shares[1];
  if (shown.views.size() > 2) result.nearer = {std::move(shown.views[2]), std::move(shown.views[3])};
}

/// Draws one view as the left picture.
void draw_one_view(ImageView<const Rgb8> photograph, ViewPosition view, const Style& style, Device device,
                   PaintedPair& result) {
  Presentation presentation{.views = {view}, .device = device};
  if (style.background == Background::photograph) presentation.backgrounds = {photograph};
  Presented shown = present(result.painting, presentation);
  result.pictures.left = std::move(shown.views.front());
  result.left_bare_share = shown.worst_bare_share;
}

/// Draws the left eye, and the right eye from it. Stavrakis & Gelautz 2004, sec. 3.2: the left picture is warped over
/// the right eye's paint, but not where the grown occlusion mask is. The paint of near things reaches beyond their
/// outlines, and what lies there is warped by the disparity of what is behind them: beside an occlusion it would be
/// seen as a second outline. What the right eye's paint leaves bare there shows the warped picture, and the few pixels
/// that neither reaches show the photograph.
void draw_right_under_left(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                           Device device, PaintedPair& result) {
  draw_one_view(photographs.left, left_eye, style, device, result);
  WarpedPicture warped = warp_picture(result.pictures.left, geometry.left_disparity, left_eye, right_eye);
  Image<Rgb8> background = copy_of(photographs.right);
  lay_over(warped, background);
  const Presentation right{.views = {right_eye}, .backgrounds = {background}, .device = device};
  result.pictures.right = std::move(present(result.painting, right).views.front());
  const Image<std::uint8_t> own = grown_occlusion(geometry.right_occlusion, style);
  for (std::size_t i = 0; i < own.pixels().size(); ++i)
    if (own.pixels()[i] != 0) warped.covered.pixels()[i] = 0;
  lay_over(warped, result.pictures.right);
  result.right_bare_share = 0;
}

void check_is_of_strokes(const Style& style) {
  if (!is_of_strokes(style))
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("style: {} cannot be painted for one view alone, expected brush strokes", name_of(style.marks)));
}

}  // namespace

Image<std::uint8_t> stretched_detail(ImageView<const std::uint8_t> map, int width, int height) {
  Image<std::uint8_t> detail(width, height);
  cv::Mat to = as_mat(detail);
  cv::resize(as_mat(map), to, to.size(), 0, 0, cv::INTER_LINEAR);
  return detail;
}

bool reads_detail(const Style& style) {
  return style.marks == Marks::fitted_strokes && style.propagation == Propagation::strokes;
}

void check_reads_detail(const Style& style) {
  if (!reads_detail(style))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("style {}: takes no detail map, expected marks = fitted-strokes and propagation = strokes, "
                            "as oil has",
                            style.name));
}

namespace {

Painting plan_still(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                    StrokeFits* fits, const Progress& progress, ViewRange wanted, ImageView<const std::uint8_t> detail,
                    std::span<const View> known) {
  check_style(style);
  check_fits(photographs, geometry);
  if (!detail.empty()) check_reads_detail(style);
  const bool apart = style.propagation == Propagation::independent || is_raster(style);
  if (apart && !photographs.right.empty()) return plan_eyes_apart(photographs, geometry, style, progress);
  std::vector<View> scene =
      known.empty() ? make_still_scene(photographs, geometry, wanted) : make_known_scene(photographs, geometry, known);
  if (same_size(detail, photographs.left)) {
    scene.front().detail = detail;
  } else if (!detail.empty()) {
    scene.front().detail = stretched_detail(detail, photographs.left.width(), photographs.left.height());
  }
  PaintingMemory nothing_before;
  return plan_frame({.views = scene}, style, {.goes_on = false}, nothing_before, progress, fits).painting;
}

}  // namespace

Painting plan_painting(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                       const Progress& progress, ViewRange wanted, ImageView<const std::uint8_t> detail,
                       std::span<const View> known) {
  return plan_still(photographs, geometry, style, nullptr, progress, wanted, detail, known);
}

Painting plan_again(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                    StrokeFits& fits, const Progress& progress, ViewRange wanted, ImageView<const std::uint8_t> detail,
                    std::span<const View> known) {
  return plan_still(photographs, geometry, style, &fits, progress, wanted, detail, known);
}

PaintedPair paint(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                  const Progress& progress, const PaintDrawing& drawing, ImageView<const std::uint8_t> detail,
                  std::span<const View> known) {
  PaintedPair result;
  {
    const Stopwatch watch(result.times.planning_s);
    result.painting = plan_painting(photographs, geometry, style, progress, widest_views, detail, known);
  }
  const Stopwatch watch(result.times.rasterising_s);
  report(progress, "drawing", 0);
  if (photographs.right.empty()) {
    draw_one_view(photographs.left, central_view, style, drawing.device, result);
  } else if (is_raster(style)) {
    draw_right_under_left(photographs, geometry, style, drawing.device, result);
  } else {
    draw_views(photographs, style, drawing, result);
  }
  report(progress, "drawing", 1);
  return result;
}

PaintedView paint_view(ImageView<const Rgb8> photograph, ImageView<const float> disparity, ViewPosition view,
                       const Style& style, const Progress& progress) {
  check_style(style);
  check_is_of_strokes(style);
  PaintedView result;
  {
    const Stopwatch watch(result.times.planning_s);
    result.painting = plan_by_itself({photograph, disparity, {}, view}, style, progress);
  }
  const Stopwatch watch(result.times.rasterising_s);
  Presentation presentation{.views = {view}};
  if (style.background == Background::photograph) presentation.backgrounds = {photograph};
  Presented shown = present(Painting{result.painting, {}, relief_for(style, photograph.width())}, presentation);
  result.picture = std::move(shown.views.front());
  result.bare_share = shown.worst_bare_share;
  return result;
}

}  // namespace wheatstone
