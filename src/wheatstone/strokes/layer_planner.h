#pragma once

#include <vector>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/progress.h"
#include "wheatstone/strokes/outline_disparity.h"
#include "wheatstone/strokes/reference_picture.h"

namespace wheatstone {

/// A style's lengths in pixels of the picture at hand: one `width` pixels wide, or that picture reduced by a factor.
struct ScaledStyle {
  ScaledStyle(const Style& style, int width, float reduction = 1);
  std::vector<float> radii_px;
  float depth_threshold_px;
  float least_gain;  ///< as LayerPlan
};

/// A view that is being painted: what it shows, and the canvas that its next layer is planned against.
struct LayerPlanner {
  LayerPlanner(ImageView<const Rgb8> photograph, ImageView<const float> disparity, ViewPosition view,
               const Style& style);
  /// On a canvas that is begun.
  LayerPlanner(ImageView<const Rgb8> photograph, ImageView<const float> disparity, ViewPosition view,
               const Style& style, Canvas begun);

  ImageView<const Rgb8> photograph;
  ImageView<const float> disparity;
  Image<std::int16_t> disparity_steps;  ///< as disparity_in_steps; empty where the style wants no depth test
  ViewPosition view;
  Canvas canvas;
  /// Strokes begin where two surfaces' colours mix only if there is no other place: the surfaces part in other views.
  bool avoid_mixed_colours = true;
  ViewsBeside beside;            ///< from which the strokes will be seen
  float least_dot_px = 1;        ///< radius of the smallest dots that cover what strokes leave bare
  float least_edge_cell_px = 1;  ///< strokes beside depth edges begin about so far apart, or farther
};

/// What one layer of one eye is planned from, whatever is on the canvas. Of the depth test, all are empty where the
/// style wants none.
struct LayerInputs {
  int layer = 0;  ///< number of the layer, from the coarsest, 0
  ReferencePicture reference;
  Image<std::uint8_t> depth_edges, mixed_colours;
  Image<float> edge_distance;
};

LayerInputs make_layer_inputs(const LayerPlanner& planner, const Style& style, const ScaledStyle& scaled, int layer);

/// 255 where the paint on the canvas has a colour that the photograph has nowhere near (marks/residual.h):
/// strokes of the finest layer are wanted there whatever the style's threshold. Empty for styles whose colours are
/// changed at random.
Image<std::uint8_t> misplaced_paint(const LayerPlanner& planner, const Style& style);

/// Where strokes begin; pixels that are not 0.
struct StrokePlaces {
  ImageView<const std::uint8_t> allowed;    ///< only here; empty: anywhere
  ImageView<const std::uint8_t> misplaced;  ///< as misplaced_paint; empty: nowhere
};

/// Plans one layer of one eye.
Layer plan_on(const LayerPlanner& planner, const LayerInputs& inputs, const Style& style, const ScaledStyle& scaled,
              const StrokePlaces& places);

/// Puts the strokes of layer number `layer` into drawing order.
void order_strokes(Layer& strokes, const Style& style, int layer);

/// Plans all layers of one eye, for it alone, each against what the coarser ones left on the canvas, with strokes that
/// begin only on the seeds, pixels that are not 0, or anywhere where `seeds` is empty.
StrokePainting plan_alone(LayerPlanner& planner, const Style& style, const ScaledStyle& scaled,
                          ImageView<const std::uint8_t> seeds, const Progress& progress = {});

}  // namespace wheatstone
