#include "wheatstone/painting/paint.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <exception>

#include "wheatstone/curves/plan_diffusion.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/draw_in_style.h"
#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/drawing/relief.h"
#include "wheatstone/error.h"
#include "wheatstone/regions/mosaic.h"
#include "wheatstone/regions/posterise.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/warp.h"
#include "wheatstone/stopwatch.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_planner.h"
#include "wheatstone/strokes/occluded_part.h"
#include "wheatstone/strokes/propagate.h"

namespace wheatstone {
namespace {

/// Plans one eye from its photograph alone.
StrokePainting plan_by_itself(ImageView<const Rgb8> photograph, ImageView<const float> disparity, ViewPosition view,
                              const Style& style, const Progress& progress) {
  LayerPlanner planner(photograph, disparity, view, style);
  return plan_alone(planner, style, ScaledStyle(style, photograph.width()), {}, progress);
}

StrokePainting plan_right_only(const StereoPairView& photographs, const StereoGeometryView& geometry,
                               const Style& style) {
  return plan_occluded_part(photographs.right, geometry.right_disparity, geometry.right_occlusion, right_eye, style);
}

/// Stavrakis & Gelautz 2005, sec. 3.2: each layer is planned in the left eye and carried to the right; what only the
/// right eye sees is planned there and carried back, and the next layer is planned against both.
StrokePainting plan_with_strokes(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                 const Style& style, const Progress& progress) {
  report(progress, "painting", 0);
  const ScaledStyle scaled(style, photographs.left.width());
  LayerPlanner left(photographs.left, geometry.left_disparity, left_eye, style);
  StrokePainting right_only;
  Layer planned;
  tbb::parallel_invoke([&] { right_only = plan_right_only(photographs, geometry, style); },
                       [&] { planned = plan_on(left, style, scaled, 0); });
  StrokePainting painting{photographs.left.width(), photographs.left.height(), style.canvas_colour, {}};
  const int layers = static_cast<int>(scaled.radii_px.size());
  for (int i = 0; i < layers; ++i) {
    if (i > 0) planned = plan_on(left, style, scaled, i);
    report(progress, "painting", (i + 0.7) / layers);
    Layer layer = propagate_to_other_eye(planned, geometry.left_occlusion);
    append_strokes(propagate_to_other_eye(right_only.layers[i], geometry.right_occlusion), layer);
    order_strokes(layer, style, i);
    if (i + 1 < layers) rasterise(layer, left.view, left.canvas);
    painting.layers.push_back(std::move(layer));
    report(progress, "painting", (i + 1.) / layers);
  }
  return painting;
}

/// Layers of two paintings of one size and style, one behind the other.
StrokePainting joined(StrokePainting left, const StrokePainting& right) {
  for (std::size_t i = 0; i < left.layers.size(); ++i) append_strokes(right.layers[i], left.layers[i]);
  return left;
}

/// Draws both eyes of a planned painting.
void draw_both(const StereoPairView& photographs, const Style& style, PaintedPair& result) {
  DrawnView left, right;
  tbb::parallel_invoke([&] { left = draw_in_style(photographs.left, result.painting.strokes, left_eye, style); },
                       [&] { right = draw_in_style(photographs.right, result.painting.strokes, right_eye, style); });
  result.pictures = {std::move(left.picture), std::move(right.picture)};
  result.left_bare_share = left.bare_share;
  result.right_bare_share = right.bare_share;
}

/// Stavrakis & Gelautz 2004, sec. 3.2: the left picture, warped, covers the right eye's paint. The few pixels that
/// neither reaches show the photograph.
void lay_left_over_right(const StereoGeometryView& geometry, PaintedPair& result) {
  lay_over(warp_picture(result.pictures.left, geometry.left_disparity, left_eye, right_eye), result.pictures.right);
  result.right_bare_share = 0;
}

StrokePainting plan(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                    const Progress& progress) {
  if (style.propagation == Propagation::strokes) return plan_with_strokes(photographs, geometry, style, progress);
  StrokePainting left, right;
  std::exception_ptr thrown;
  tbb::parallel_invoke(
      [&] {
        // Thrown on when the right eye has ended, too: its loops would be cancelled, and it would go on with what they
        // have not done.
        try {
          left = plan_by_itself(photographs.left, geometry.left_disparity, left_eye, style, progress);
        } catch (...) {
          thrown = std::current_exception();
        }
      },
      [&] {
        right = style.propagation == Propagation::raster
                    ? plan_right_only(photographs, geometry, style)
                    : plan_by_itself(photographs.right, geometry.right_disparity, right_eye, style, {});
      });
  if (thrown) std::rethrow_exception(thrown);
  return joined(std::move(left), right);
}

/// Plans the kinds of marks that are not strokes.
void plan_other_marks(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                      Painting& painting) {
  if (style.marks == Marks::regions) painting.regions = plan_posterised(photographs, geometry, style);
  if (style.marks == Marks::tiles) painting.regions = plan_mosaic(photographs, geometry, style);
  if (style.marks == Marks::curves) painting.curves = plan_diffusion(photographs, geometry, style);
}

/// Draws both eyes of regions or curves.
void draw_other_marks(PaintedPair& result) {
  DrawnView left, right;
  tbb::parallel_invoke([&] { left = draw(result.painting, left_eye); },
                       [&] { right = draw(result.painting, right_eye); });
  result.pictures = {std::move(left.picture), std::move(right.picture)};
  result.left_bare_share = left.bare_share;
  result.right_bare_share = right.bare_share;
}

void check_is_of_strokes(const Style& style) {
  if (style.marks != Marks::strokes)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("style: {} cannot be painted for one view alone, expected brush strokes", name_of(style.marks)));
}

}  // namespace

Painting plan_painting(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                       const Progress& progress) {
  check_style(style);
  check_fits(photographs, geometry);
  Painting painting;
  if (style.marks == Marks::strokes) {
    painting.strokes = plan(photographs, geometry, style, progress);
    painting.relief = relief_for(style, painting.strokes.width);
    return painting;
  }
  report(progress, "painting", 0);
  painting.strokes.width = photographs.left.width();
  painting.strokes.height = photographs.left.height();
  plan_other_marks(photographs, geometry, style, painting);
  return painting;
}

PaintedPair paint(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                  const Progress& progress) {
  PaintedPair result;
  {
    const Stopwatch watch(result.times.planning_s);
    result.painting = plan_painting(photographs, geometry, style, progress);
  }
  const Stopwatch watch(result.times.rasterising_s);
  report(progress, "drawing", 0);
  if (style.marks == Marks::strokes) {
    draw_both(photographs, style, result);
    if (style.propagation == Propagation::raster) lay_left_over_right(geometry, result);
  } else {
    draw_other_marks(result);
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
    result.painting = plan_by_itself(photograph, disparity, view, style, progress);
  }
  const Stopwatch watch(result.times.rasterising_s);
  DrawnView drawn = draw_in_style(photograph, result.painting, view, style);
  result.picture = std::move(drawn.picture);
  result.bare_share = drawn.bare_share;
  return result;
}

}  // namespace wheatstone
