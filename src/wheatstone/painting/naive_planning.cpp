#include <tbb/parallel_invoke.h>

#include <exception>
#include <utility>

#include "wheatstone/drawing/relief.h"
#include "wheatstone/painting/naive_planning_internal.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_planner.h"
#include "wheatstone/strokes/occluded_part.h"

namespace wheatstone {
namespace {

void show_only_in(ViewPosition view, StrokePainting& painting) {
  for (Layer& layer : painting.layers)
    for (Stroke& stroke : layer.strokes) stroke.views = {view, view};
}

StrokePainting plan_right_only(const StereoPairView& photographs, const StereoGeometryView& geometry,
                               const Style& style) {
  StrokePainting painting =
      plan_occluded_part(photographs.right, geometry.right_disparity, geometry.right_occlusion, right_eye, style);
  show_only_in(right_eye, painting);
  return painting;
}

/// Layers of two paintings of one size and style, one behind the other.
StrokePainting joined(StrokePainting left, const StrokePainting& right) {
  for (std::size_t i = 0; i < left.layers.size(); ++i) append_strokes(right.layers[i], left.layers[i]);
  return left;
}

StrokePainting plan_strokes_of_each(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                    const Style& style, const Progress& progress) {
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

}  // namespace

StrokePainting plan_by_itself(ImageView<const Rgb8> photograph, ImageView<const float> disparity, ViewPosition view,
                              const Style& style, const Progress& progress) {
  LayerPlanner planner(photograph, disparity, view, style);
  StrokePainting painting = plan_alone(planner, style, ScaledStyle(style, photograph.width()), {}, progress);
  show_only_in(view, painting);
  return painting;
}

Painting plan_eyes_apart(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                         const Progress& progress) {
  Painting painting;
  if (is_of_strokes(style)) {
    painting.marks = plan_strokes_of_each(photographs, geometry, style, progress);
    painting.relief = relief_for(style, width_of(painting));
    return painting;
  }
  const std::vector<SceneView> views = scene_from_left(photographs, geometry);
  PaintingMemory nothing;
  painting = plan_painting({.views = views}, style, {}, nothing, progress).painting;
  painting.surfaces = {};
  return painting;
}

}  // namespace wheatstone
