#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/random.h"
#include "wheatstone/strokes/depth_edges_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_planner.h"
#include "wheatstone/strokes/plan_layer_internal.h"
#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {

namespace {

/// Radii from the broadest brush down to the finest, each .62 of the one before.
std::vector<float> radii_between(float broadest_px, float finest_px) {
  constexpr float ratio = 0.62f;
  std::vector<float> radii;
  for (float radius = broadest_px; radius > finest_px; radius *= ratio) radii.push_back(radius);
  radii.push_back(finest_px);
  return radii;
}

/// Larger pictures show more detail than anybody looks at: a stroke has to do more in them.
float least_gain_of(const Style& style, int width) {
  constexpr float usual = 190, usual_width = 400, steps_of_fineness = 12;
  const float size = std::max(static_cast<float>(width) / usual_width, 1.f);
  return usual * std::exp2(steps_of_fineness * (0.5f - style.fineness)) * size;
}

}  // namespace

ScaledStyle::ScaledStyle(const Style& style, int width, float reduction)
    : depth_threshold_px(style.depth_threshold_px * style_scale(style, width) / reduction),
      least_gain(least_gain_of(style, width) / (reduction * reduction)) {
  constexpr float least_px = 1;
  if (style.marks == Marks::fitted_strokes) {
    radii_px = radii_between(style.radii_px.front() * style_scale(style, width), style.radii_px.back());
    for (float& radius : radii_px) radius /= reduction;
    return;
  }
  for (const float radius : style.radii_px)
    radii_px.push_back(std::max(radius * style_scale(style, width), least_px) / reduction);
}

LayerPlanner::LayerPlanner(ImageView<const Rgb8> photograph_, ImageView<const float> disparity_, ViewPosition view_,
                           const Style& style, Canvas begun)
    : photograph(photograph_),
      disparity(disparity_),
      disparity_steps(style.depth_test ? disparity_in_steps(disparity) : Image<std::int16_t>()),
      view(view_),
      canvas(std::move(begun)) {}

LayerPlanner::LayerPlanner(ImageView<const Rgb8> photograph_, ImageView<const float> disparity_, ViewPosition view_,
                           const Style& style)
    : LayerPlanner(photograph_, disparity_, view_, style,
                   style.background == Background::photograph
                       ? make_canvas(photograph_)
                       : Canvas(photograph_.width(), photograph_.height(), style.canvas_colour)) {}

LayerInputs make_layer_inputs(const LayerPlanner& planner, const Style& style, const ScaledStyle& scaled, int layer) {
  const float radius = scaled.radii_px[layer], threshold = scaled.depth_threshold_px;
  const bool finest = layer + 1 == static_cast<int>(scaled.radii_px.size());
  LayerInputs inputs{.layer = layer};
  tbb::parallel_invoke([&] { inputs.reference = make_reference(planner.photograph, radius, style); },
                       [&] {
                         if (!style.depth_test) return;
                         inputs.depth_edges = near_depth_edge(planner.disparity_steps, radius, threshold);
                         if (!finest) return;
                         inputs.edge_distance = distance_to_depth_edge(planner.disparity_steps, threshold,
                                                                       radius + known_edge_distance_px);
                         if (planner.avoid_mixed_colours)
                           inputs.mixed_colours = behind_depth_edge(planner.disparity_steps, radius / 2, threshold);
                       });
  return inputs;
}

Image<std::uint8_t> misplaced_paint(const LayerPlanner& planner, const Style& style) {
  if (style.jitter != ColourJitter{}) return {};
  return residual(picture_of(planner.canvas), planner.photograph);
}

Layer plan_on(const LayerPlanner& planner, const LayerInputs& inputs, const Style& style, const ScaledStyle& scaled,
              const StrokePlaces& places) {
  constexpr float no_threshold_px = 1e9f;
  const LayerPlan plan{.reference = inputs.reference,
                       .canvas = planner.canvas,
                       .disparity = planner.disparity,
                       .seeds = places.allowed,
                       .misplaced = places.misplaced,
                       .view = planner.view,
                       .radius_px = scaled.radii_px[inputs.layer],
                       .layer = inputs.layer,
                       .beside = planner.beside,
                       .least_gain = scaled.least_gain,
                       .depth_threshold_px = style.depth_test ? scaled.depth_threshold_px : no_threshold_px,
                       .least_edge_cell_px = planner.least_edge_cell_px,
                       .depth_edges = inputs.depth_edges,
                       .edge_distance = inputs.edge_distance,
                       .mixed_colours = inputs.mixed_colours};
  return style.marks == Marks::fitted_strokes ? fit_layer(plan, style) : plan_layer(plan, style);
}

void order_strokes(Layer& strokes, const Style& style, int layer) {
  if (style.marks == Marks::fitted_strokes) return;  // planned in that order
  sort_far_to_near(strokes, hash_keys({style.seed, static_cast<std::uint64_t>(layer)}));
}

StrokePainting plan_alone(LayerPlanner& planner, const Style& style, const ScaledStyle& scaled,
                          ImageView<const std::uint8_t> seeds, const Progress& progress) {
  StrokePainting painting{planner.canvas.width,
                          planner.canvas.height,
                          style.canvas_colour,
                          {},
                          true,
                          brush_for(style, planner.canvas.width)};
  const int layers = static_cast<int>(scaled.radii_px.size());
  for (int i = 0; i < layers; ++i) {
    report(progress, "painting", static_cast<double>(i) / layers);
    const LayerInputs inputs = make_layer_inputs(planner, style, scaled, i);
    const Image<std::uint8_t> misplaced = i + 1 == layers ? misplaced_paint(planner, style) : Image<std::uint8_t>();
    painting.layers.push_back(plan_on(planner, inputs, style, scaled, {seeds, misplaced}));
    order_strokes(painting.layers.back(), style, i);
    if (i + 1 < layers)
      rasterise(painting.layers.back(), planner.view,
                {.surface = planner.disparity, .tolerance_px = scaled.depth_threshold_px}, planner.canvas);
  }
  report(progress, "painting", 1);
  return painting;
}

}  // namespace wheatstone
