#include <tbb/parallel_invoke.h>

#include <exception>
#include <utility>

#include "wheatstone/drawing/relief.h"
#include "wheatstone/painting/naive_planning_internal.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_plan.h"
#include "wheatstone/strokes/occluded_part.h"

namespace wheatstone {
namespace {

StrokePainting shown_only_in(const View& view, const Style& style, std::vector<Layer> layers) {
  for (Layer& layer : layers)
    for (Stroke& stroke : layer.strokes) stroke.views = {view.position, view.position};
  const int width = view.colour.width();
  return {width, view.colour.height(), style.canvas_colour, std::move(layers), true, brush_for(style, width)};
}

/// Layers of two paintings of one size and style, one behind the other.
StrokePainting joined(StrokePainting left, const StrokePainting& right) {
  for (std::size_t i = 0; i < left.layers.size(); ++i) append_strokes(right.layers[i], left.layers[i]);
  return left;
}

StrokePainting plan_strokes_of_each(std::span<const View> eyes, const Style& style, const Progress& progress) {
  StrokePainting left, right;
  std::exception_ptr thrown;
  tbb::parallel_invoke(
      [&] {
        // Thrown again when the right eye has ended, too: otherwise its loops would be cancelled, and it would go on
        // with unfinished results.
        try {
          left = plan_by_itself(eyes[0], style, progress);
        } catch (...) {
          thrown = std::current_exception();
        }
      },
      [&] {
        right = style.propagation == Propagation::raster
                    ? shown_only_in(eyes[1], style, plan_occluded_part(eyes[1], style))
                    : plan_by_itself(eyes[1], style, {});
      });
  if (thrown) std::rethrow_exception(thrown);
  return joined(std::move(left), right);
}

}  // namespace

StrokePainting plan_by_itself(View view, const Style& style, const Progress& progress) {
  view.wanted = {};
  ViewOnCanvas at(view, style, view.colour.width());
  return shown_only_in(view, style, plan_alone(at, style, progress));
}

Painting plan_eyes_apart(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                         const Progress& progress) {
  const std::vector<View> eyes = scene_from_left(photographs, geometry);
  Painting painting;
  if (is_of_strokes(style)) {
    painting.marks = plan_strokes_of_each(eyes, style, progress);
    painting.relief = relief_for(style, width_of(painting));
    return painting;
  }
  PaintingMemory nothing;
  painting = plan_frame({.views = eyes}, style, {}, nothing, progress).painting;
  painting.surfaces = {};
  return painting;
}

}  // namespace wheatstone
