#include "wheatstone/app/film_display.h"

#include <utility>

#include "wheatstone/app/draw_composed.h"
#include "wheatstone/app/slow_ends_internal.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"

namespace wheatstone {

void follow_depth(const DepthEnds& frame, bool scene_begins, SceneDepth& scene) {
  if (scene_begins) {
    scene = {frame, frame};
    return;
  }
  widen_slowly(frame.farthest_px, frame.nearest_px, scene.ends.farthest_px, scene.ends.nearest_px);
}

ViewRange planned_views(PictureSize frame, const SceneDepth& scene, const DisplayViewsOptions& options) {
  const float half = plan_display_views(frame, scene.first, options).span / 2;
  return {ViewPosition(-half), ViewPosition(half)};
}

DisplayedFrame draw_for_display(const Painting& painting, const SceneDepth& scene, const FilmDisplay& display) {
  const DisplayViewsPlan plan =
      plan_display_views({width_of(painting), height_of(painting)}, scene.ends, display.views);
  if (!display.quilt && !display.screen)
    throw Error(ErrorKind::wrong_usage, "the display takes neither quilts nor lenticular pictures");
  const DisplayComposition composition =
      display.quilt ? DisplayComposition(*display.quilt) : DisplayComposition(*display.screen);
  const PreparedPainting prepared = prepare(painting, {.placement = plan.placement}, display.views.device);
  ComposedViews composed = draw_composed(prepared, plan.rig.positions, composition);
  return {std::move(composed.picture), composed.worst_bare_share};
}

}  // namespace wheatstone
