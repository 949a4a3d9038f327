#pragma once

#include <optional>

#include "wheatstone/app/display_views.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"

namespace wheatstone {

/// A display with many views for which a film is painted: each frame becomes one quilt, or one picture with the views
/// interleaved under lenses.
struct FilmDisplay {
  DisplayViewsOptions views;
  std::optional<QuiltLayout> quilt;
  std::optional<LenticularScreen> screen;  ///< where there is no quilt
};

/// How deep a scene of a film is. What depends on it must neither jump nor breathe within a scene.
struct SceneDepth {
  DepthEnds first;  ///< of the scene's first frame
  DepthEnds ends;   ///< these widened, slowly, by what later frames show
};

/// Takes a frame's depth into that of its scene. A frame that is deeper widens the scene's depth by a small part of the
/// difference, so that the whole is reached in about a second; no frame narrows it.
void follow_depth(const DepthEnds& frame, bool scene_begins, SceneDepth& scene);

/// Which views beside the eyes the frames of a scene are planned for: the same for all of them.
ViewRange planned_views(PictureSize frame, const SceneDepth& scene, const DisplayViewsOptions& options);

struct DisplayedFrame {
  Image<Rgb8> picture;
  double worst_bare_share = 0;  ///< of a view's pixels that marks cover less than half
};

/// Draws a frame's painting for the display. Of a quilt only a few views are in memory beside it.
DisplayedFrame draw_for_display(const Painting& painting, const SceneDepth& scene, const FilmDisplay& display);

}  // namespace wheatstone
