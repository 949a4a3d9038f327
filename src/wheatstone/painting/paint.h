#pragma once

#include <optional>
#include <span>

#include "wheatstone/gpu/gpu.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

/// Where the time of a painting went, in seconds, over all eyes and layers. Planning includes drawing the coarser
/// layers, against which the finer ones are planned; rasterising is drawing the finished pictures.
struct PaintingTimes {
  double planning_s = 0;
  double rasterising_s = 0;
};

/// A painting and its pictures for two eyes. With Propagation::raster the right picture is made from pixels and is not
/// what `draw` makes of the marks.
struct PaintedPair {
  Painting painting;
  StereoPair pictures;
  double left_bare_share = 0;  ///< of the pixels, 0..1, that no mark covers
  double right_bare_share = 0;
  StereoPair nearer;  ///< for eyes nearer together, which are `separation` apart; empty where that is 1
  float separation = 1;
  PaintingTimes times;
};

/// How a planned painting is drawn.
struct PaintDrawing {
  std::optional<float> depth_budget = {};  ///< of pictures for nearer eyes, as comfortable_separation; none: no such
  Device device = Device::processor;
};

/// The views that paintings of photographs can be drawn for: five eye separations.
inline constexpr ViewRange widest_views{ViewPosition(-2.5f), ViewPosition(2.5f)};

/// Plans the painting of a rectified pair, for any of the `wanted` views. The geometry must have the pair's size and no
/// unknown disparity. If each eye is planned by itself, and with Propagation::raster, there are two views only.
/// `detail` says how finely each place of the left view is painted with fitted strokes (View::detail), stretched over
/// it; empty: all evenly. `known` are views that show parts hidden in the left one, with a mask of these parts, if all
/// of the scene is known (make_known_scene); empty: these parts are found from the photographs. Throws
/// Error{wrong_usage} for a style that cannot be painted with, or not by a detail map, Error{bad_input} for a geometry
/// that does not fit.
Painting plan_painting(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                       const Progress& progress = {}, ViewRange wanted = widest_views,
                       ImageView<const std::uint8_t> detail = {}, std::span<const View> known = {});

/// As plan_painting, with the same result, in less time where only parts of the disparities or of the detail map differ
/// from the last call with these `fits`, which are empty at first: fitted strokes are planned again where something
/// differs that they depend on. (All other marks are planned everywhere; they are planned fast.) The fits take about
/// 270 bytes a pixel. They stay good if this throws.
Painting plan_again(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                    StrokeFits& fits, const Progress& progress = {}, ViewRange wanted = widest_views,
                    ImageView<const std::uint8_t> detail = {}, std::span<const View> known = {});

/// A detail map of any size, stretched over a picture of this size.
Image<std::uint8_t> stretched_detail(ImageView<const std::uint8_t> map, int width, int height);

/// Whether a detail map steers a style: its strokes are fitted and propagated.
bool reads_detail(const Style& style);
/// Throws Error{wrong_usage} for a style that no detail map steers.
void check_reads_detail(const Style& style);

/// Paints a rectified pair so that its marks fuse. Takes and throws what plan_painting does.
PaintedPair paint(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                  const Progress& progress = {}, const PaintDrawing& drawing = {},
                  ImageView<const std::uint8_t> detail = {}, std::span<const View> known = {});

/// One eye, painted alone.
struct PaintedView {
  StrokePainting painting;
  Image<Rgb8> picture;
  double bare_share = 0;
  PaintingTimes times;
};

/// Paints one view from its photograph and disparity, for itself alone, with strokes.
PaintedView paint_view(ImageView<const Rgb8> photograph, ImageView<const float> disparity, ViewPosition view,
                       const Style& style, const Progress& progress = {});

}  // namespace wheatstone
