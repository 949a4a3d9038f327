#include "wheatstone/painting/paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/relief.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/naive_planning_internal.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/warp.h"
#include "wheatstone/stopwatch.h"
#include "wheatstone/strokes/occluded_part.h"

namespace wheatstone {
namespace {

/// Draws both eyes of a planned painting, and other views, which have no photograph to be drawn over.
void draw_views(const StereoPairView& photographs, const Style& style, const PaintDrawing& drawing,
                const PreparedPainting& prepared, PaintedPair& result) {
  const auto others = drawing.other_views ? drawing.other_views(result.painting) : std::vector<ViewPosition>();
  std::vector<ViewPosition> views{left_eye, right_eye};
  std::vector<ImageView<const Rgb8>> backgrounds;
  if (style.background == Background::photograph) {
    backgrounds = {photographs.left, photographs.right};
    backgrounds.resize(views.size() + others.size());
  }
  views.insert(views.end(), others.begin(), others.end());
  std::vector<DrawnView> drawn = draw(prepared, views, backgrounds);
  result.pictures = {std::move(drawn[0].picture), std::move(drawn[1].picture)};
  result.left_bare_share = drawn[0].bare_share;
  result.right_bare_share = drawn[1].bare_share;
  for (DrawnView& other : std::span(drawn).subspan(2)) result.other_views.push_back(std::move(other.picture));
}

/// Stavrakis & Gelautz 2004, sec. 3.2: the left picture is warped over the right eye's paint, but not where the grown
/// occlusion mask is. The paint of near things reaches beyond their outlines, and what lies there is warped by the
/// disparity of what is behind them: beside an occlusion it would be seen as a second outline. What the right eye's
/// paint leaves bare there shows the warped picture, and the few pixels that neither reaches show the photograph.
void draw_right_under_left(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                           const PreparedPainting& prepared, PaintedPair& result) {
  WarpedPicture warped = warp_picture(result.pictures.left, geometry.left_disparity, left_eye, right_eye);
  Image<Rgb8> background(photographs.right.width(), photographs.right.height());
  for (int y = 0; y < background.height(); ++y) std::ranges::copy(photographs.right.row(y), background.row(y).begin());
  lay_over(warped, background);
  result.pictures.right = draw(prepared, right_eye, background).picture;
  const Image<std::uint8_t> own = grown_occlusion(geometry.right_occlusion, style);
  for (std::size_t i = 0; i < own.pixels().size(); ++i)
    if (own.pixels()[i] != 0) warped.covered.pixels()[i] = 0;
  lay_over(warped, result.pictures.right);
  result.right_bare_share = 0;
}

void check_is_of_strokes(const Style& style) {
  if (style.marks != Marks::strokes)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("style: {} cannot be painted for one view alone, expected brush strokes", name_of(style.marks)));
}

}  // namespace

Painting plan_painting(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                       const Progress& progress, ViewRange wanted) {
  check_style(style);
  check_fits(photographs, geometry);
  const bool apart = style.propagation == Propagation::independent ||
                     (style.propagation == Propagation::raster && style.marks == Marks::strokes);
  if (apart) return plan_eyes_apart(photographs, geometry, style, progress);
  const StillScene scene = make_still_scene(photographs, geometry, wanted);
  PaintingMemory nothing_before;
  return plan_painting(FilmFrame{.views = scene.views}, style, CarryOptions{.goes_on = false}, nothing_before, progress)
      .painting;
}

PaintedPair paint(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                  const Progress& progress, const PaintDrawing& drawing) {
  PaintedPair result;
  {
    const Stopwatch watch(result.times.planning_s);
    result.painting = plan_painting(photographs, geometry, style, progress);
  }
  const Stopwatch watch(result.times.rasterising_s);
  report(progress, "drawing", 0);
  const PreparedPainting prepared = prepare(result.painting, {}, drawing.device);
  draw_views(photographs, style, drawing, prepared, result);
  if (style.propagation == Propagation::raster && style.marks == Marks::strokes)
    draw_right_under_left(photographs, geometry, style, prepared, result);
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
    result.painting = plan_by_itself(photograph, disparity, view, style, progress);
  }
  const Stopwatch watch(result.times.rasterising_s);
  const PreparedPainting prepared = prepare(Painting{result.painting, {}, relief_for(style, photograph.width())});
  const bool over_photograph = style.background == Background::photograph;
  DrawnView drawn = draw(prepared, view, over_photograph ? photograph : ImageView<const Rgb8>());
  result.picture = std::move(drawn.picture);
  result.bare_share = drawn.bare_share;
  return result;
}

}  // namespace wheatstone
