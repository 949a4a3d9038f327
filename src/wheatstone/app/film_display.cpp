#include "wheatstone/app/film_display.h"

#include <algorithm>
#include <utility>

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
  const PreparedPainting prepared = prepare(painting, {.placement = plan.placement});
  DisplayedFrame frame;
  if (display.quilt) {
    frame.picture = Image<Rgb8>(display.quilt->columns * plan.rig.width, display.quilt->rows * plan.rig.height);
    const ViewSink put = [&](std::size_t place, DrawnView view) {
      frame.worst_bare_share = std::max(frame.worst_bare_share, view.bare_share);
      put_into_quilt(view.picture, static_cast<int>(place), *display.quilt, frame.picture);
    };
    draw(prepared, plan.rig.positions, put);
    return frame;
  }
  if (!display.screen) throw Error(ErrorKind::wrong_usage, "the display takes neither quilts nor lenticular pictures");
  std::vector<Image<Rgb8>> views;
  const ViewSink keep = [&](std::size_t /*place*/, DrawnView view) {
    frame.worst_bare_share = std::max(frame.worst_bare_share, view.bare_share);
    views.push_back(std::move(view.picture));
  };
  draw(prepared, plan.rig.positions, keep);
  frame.picture = interleave(views, *display.screen);
  return frame;
}

}  // namespace wheatstone
