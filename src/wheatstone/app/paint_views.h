#pragma once

#include "wheatstone/app/display_views.h"
#include "wheatstone/app/paint_photograph.h"

namespace wheatstone {

/// A photograph painted for a display, and how sure its matching is.
struct PaintedViews {
  DisplayViews views;
  std::optional<MatchConfidence> confidence;  ///< of what was matched; none where disparity was given
};

/// One stereo photograph, painted once, for every view of a display: what draw_display_views makes of its painting. The
/// screen plane is `painting.zero_parallax` where that is given, else that of `views`. Throws as paint_photograph and
/// draw_display_views do.
PaintedViews paint_views(const StereoPair& photographs, const PaintPhotographOptions& painting,
                         DisplayViewsOptions views, const Progress& progress = {},
                         const std::optional<DisplayComposition>& composition = {});

}  // namespace wheatstone
