#pragma once

#include <vector>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/depth/rig.h"

namespace wheatstone {

/// The views that a display wants, of a painted photograph.
struct PaintViewsOptions {
  PaintPhotographOptions painting;  ///< its screen plane, where not given, is the middle of the scene's disparities
  int views = 48;
  int width = 420, height = 560;  ///< of a view
  float span = 0;                 ///< eye separations of the photographs between the outermost views; 0: `widest_span`
                                  ///< at most, but no more than parts near and far by `depth_share` of the width
  float widest_span = 4;
  float depth_share = 0.2f;
};

struct PaintedViews {
  std::vector<Image<Rgb8>> views;  ///< left to right
  Rig rig;
  float span = 0;               ///< as chosen
  float zero_parallax_px = 0;   ///< in pixels of the photographs
  double worst_bare_share = 0;  ///< of a view's pixels that no mark covered, which took their neighbours' colours
  std::optional<MatchConfidence> confidence;  ///< of what was matched; none where disparity was given
};

/// One stereo photograph, painted once, for every view of a display. Throws as paint_photograph does.
PaintedViews paint_views(const StereoPair& photographs, const PaintViewsOptions& options,
                         const Progress& progress = {});

}  // namespace wheatstone
