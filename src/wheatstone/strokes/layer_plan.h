#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "wheatstone/image/known_runs.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/strokes/begun_canvas.h"
#include "wheatstone/strokes/outline_disparity.h"
#include "wheatstone/strokes/reference_picture.h"

namespace wheatstone {

/// The powers of two by which the required gain of a stroke is smaller with a fineness of 1 than with one of 0.
inline constexpr float steps_of_fineness = 12;

/// A style's lengths in a view's pixels. The reference view is `width` pixels wide, and the view's pixels are `scale`
/// of its pixels wide.
struct ScaledStyle {
  ScaledStyle(const Style& style, int width, int scale = 1);
  std::vector<float> radii_px;
  float depth_threshold_px;
  float least_dot_px;  ///< radius of the smallest dots that cover what strokes leave bare
  float least_gain;    ///< by which a fitted stroke must lower the squared differences under it
  Brush brush;
};

/// A view that is being painted, in its own pixels: what it shows, and the canvas on which its strokes are drawn so
/// far.
struct ViewOnCanvas {
  /// On a canvas of the style. `reference_width` is that of the reference view.
  ViewOnCanvas(View view, const Style& style, int reference_width);
  /// On a canvas that is begun.
  ViewOnCanvas(View view, const Style& style, int reference_width, Canvas begun);

  BegunCanvas begun() const {
    return {canvas, canvas_factor, view.colour.width(), view.colour.height(), to_draw ? &*to_draw : nullptr};
  }

  View view;
  ScaledStyle scaled;
  Canvas canvas;
  int canvas_factor = 1;                 ///< how many times smaller than the view the canvas is
  std::optional<StrokesToDraw> to_draw;  ///< on the canvas as large as the view
  ViewsBeside beside;                    ///< from which the strokes will be seen
};

/// Distances to depth edges are known up to this much more than the brush's radius.
inline constexpr float known_edge_distance_px = 3;

struct LayerFit;

/// What one layer of a view is planned from. Everything but the canvas, which may be smaller, has the view's size and
/// is in the view's pixels: a planner knows neither how they are scaled nor which view is the reference. Borrows what
/// it refers to.
struct LayerPlan {
  const Style& style;
  const View& view;
  BegunCanvas canvas;
  std::shared_ptr<const ReferencePicture> reference;
  float radius_px = 4;
  int layer = 0;                            ///< from the coarsest, 0; numbers the layer's random choices
  ImageView<const std::uint8_t> seeds;      ///< strokes begin only where it is not 0; empty: everywhere
  ImageView<const std::uint8_t> misplaced;  ///< as misplaced_paint: strokes are wanted first there; empty: nowhere
  ViewsBeside beside = {};                  ///< from which its strokes will be seen
  float least_gain = 0;                     ///< as ScaledStyle; less for broad strokes
  LayerFit* fit = nullptr;                  ///< of fitted strokes: as it was left the last time, and will be

  // The depth test; all are empty where the style wants none.
  float depth_threshold_px = 2;            ///< T_depth; without the test, more than any disparity
  float least_edge_cell_px = 1;            ///< of the grid beside depth edges
  Image<std::uint8_t> depth_edges = {};    ///< as near_depth_edge
  KnownRuns edge_distance = {};            ///< as distance_to_depth_edge; empty: leave the edges to a finer layer
  Image<std::uint8_t> mixed_colours = {};  ///< as behind_depth_edge: no stroke takes its colour there
};

/// Prepares one layer, whose strokes may begin where the view is wanted. `fit`: as LayerPlan's; what it holds and would
/// be made again in the same way is taken from it.
LayerPlan make_layer_plan(const ViewOnCanvas& at, const Style& style, int layer, LayerFit* fit = nullptr);

/// 255 where the paint on the canvas has a colour that the view has nowhere near (marks/residual.h): strokes of the
/// finest layer are wanted there whatever the style's threshold. Empty for styles whose colours are changed at random.
Image<std::uint8_t> misplaced_paint(const ViewOnCanvas& at, const Style& style);

/// Plans the strokes of one layer, as the style's marks are. Fitted strokes are in drawing order, each on those before
/// it; traced ones (Hertzmann 1998; Stavrakis & Gelautz 2004, sec. 3.2 and 3.3): one for every grid cell
/// whose largest error, over the cell, is above the threshold, or that has misplaced paint. Beside depth edges, where
/// the brush does not fit, it is used edgeways: on a grid of half the cells, strokes as wide as the distance to the
/// edge allows. In the order of the cells, not yet in drawing order.
Layer plan_layer(const LayerPlan& plan);

/// Plans all layers of a view by itself, each against what the coarser ones left on the canvas; each in drawing order,
/// and in the reference view's pixels.
std::vector<Layer> plan_alone(ViewOnCanvas& at, const Style& style, const Progress& progress = {});

}  // namespace wheatstone
