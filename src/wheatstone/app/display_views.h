#pragma once

#include <optional>

#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/view_framing.h"
#include "wheatstone/marks/mapped_depth.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// The views of a painting that a display wants. By default the painting fills a view's picture, cropped at its middle.
struct DisplayViewsOptions {
  int views = 48;
  int width = 420, height = 560;  ///< of a view
  float span = 0;                 ///< eye separations of the photographs between the outermost views; 0: `widest_span`
                                  ///< at most, but no more than parts near and far by `depth_share` of the width
  float widest_span = 4;
  float depth_share = 0.2f;
  Device device = Device::processor;      ///< what draws them
  ViewFraming framing = {};               ///< of the part that both eyes show
  std::optional<float> zero_parallax_px;  ///< disparity on the screen plane; none: the middle of the scene's
  DepthPlacing depth =
      {};  ///< with regions they say what lies on the screen, and `span` is `widest_span` where it is 0
};

/// The options that suit a display.
DisplayViewsOptions views_of_display(const DisplayPreset& display);

/// How a painting is shown on a display with many views.
struct DisplayPlan {
  Presentation presentation;
  float span = 0;              ///< eye separations between the outermost views, as chosen
  float zero_parallax_px = 0;  ///< in pixels of the painting
};

/// Chooses the screen plane and the span for a painting of this size whose disparities, in its pixels, have these ends.
/// Throws Error{wrong_usage} where there are no views, or the screen plane leaves nothing to show.
DisplayPlan plan_display(PictureSize painting, const DepthEnds& ends, const DisplayViewsOptions& options);

/// Throws Error{bad_input} where a painting has none, as those of two eyes and of old files.
void check_has_surfaces(const Surfaces& surfaces);

/// A painting as a display shows it, and how that was chosen.
struct DisplayViews {
  DisplayPlan plan;
  Presented shown;  ///< its views from left to right, or what is composed of them
};

/// Draws a painting for a display: its views, or where a composition is given, the one picture of them. Throws
/// as check_has_surfaces where other views than those of the two eyes are wanted.
DisplayViews draw_display_views(const Painting& painting, const DisplayViewsOptions& options,
                                const Progress& progress = {},
                                const std::optional<DisplayComposition>& composition = {});

/// The views of a photograph for a display, not painted: each shows what the photographs show of it; elsewhere, the
/// farther neighbouring surface continues (make_outer_view). Screen plane, span and framing are chosen as for a
/// painting (plan_display). `stretch` is that of the views' pixels, as ShownPart has it. The geometry has no unknowns.
/// Throws Error{wrong_usage} as plan_display does.
std::vector<Image<Rgb8>> draw_photograph_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                               const DisplayViewsOptions& options, double stretch = 1,
                                               const Progress& progress = {});

}  // namespace wheatstone
