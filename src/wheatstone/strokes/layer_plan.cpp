#include "wheatstone/strokes/layer_plan.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/random.h"
#include "wheatstone/strokes/begun_canvas_internal.h"
#include "wheatstone/strokes/depth_edges_internal.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/handed_back_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/refit_internal.h"

namespace wheatstone {
namespace {

Canvas canvas_of(const View& view, const Style& style) {
  if (style.background == Background::photograph) return make_canvas(view.colour);
  return {view.colour.width(), view.colour.height(), style.canvas_colour};
}

/// Radii from the broadest brush down to the finest, in even steps of about .45.
std::vector<float> radii_between(float broadest_px, float finest_px) {
  constexpr float usual_step = 0.45f;
  const float steps = std::max(std::round(std::log(finest_px / broadest_px) / std::log(usual_step)), 1.f);
  const float step = std::pow(finest_px / broadest_px, 1 / steps);
  std::vector<float> radii;
  for (float i = 0; i < steps; ++i) radii.push_back(broadest_px * std::pow(step, i));
  radii.push_back(finest_px);
  return radii;
}

/// In pixels of the reference view, from the coarsest layer.
std::vector<float> radii_of(const Style& style, int width) {
  const float scale = style_scale(style, width);
  if (style.marks == Marks::fitted_strokes) return radii_between(style.radii_px.front() * scale, style.radii_px.back());
  constexpr float least_px = 1;
  std::vector<float> radii;
  for (const float radius : style.radii_px) radii.push_back(std::max(radius * scale, least_px));
  return radii;
}

/// Larger pictures show more detail than anybody looks at: a stroke has to do more in them.
float least_gain_of(const Style& style, int width) {
  constexpr float usual = 190, usual_width = 400;
  const float size = std::max(static_cast<float>(width) / usual_width, 1.f);
  return usual * std::exp2(steps_of_fineness * (0.5f - style.fineness)) * size;
}

std::shared_ptr<const ReferencePicture> reference_for(ImageView<const Rgb8> colour, float radius_px, const Style& style,
                                                      const LayerFit* fit) {
  if (fit != nullptr && fit->is_made_from(colour, radius_px, style)) return fit->reference;
  return std::make_shared<const ReferencePicture>(make_reference(colour, radius_px, style));
}

}  // namespace

ScaledStyle::ScaledStyle(const Style& style, int width, int scale)
    : radii_px(radii_of(style, width)),
      depth_threshold_px(style.depth_threshold_px * style_scale(style, width) / static_cast<float>(scale)),
      least_dot_px(scale > 1 ? 0.6f : 1),  // little wider than a pixel that stands for several
      least_gain(least_gain_of(style, width) / static_cast<float>(scale * scale)),
      brush(brush_for(style, width)) {
  for (float& radius : radii_px) radius /= static_cast<float>(scale);
  brush.bristle_px /= static_cast<float>(scale);
}

ViewOnCanvas::ViewOnCanvas(View view_, const Style& style, int reference_width, Canvas begun)
    : view(std::move(view_)), scaled(style, reference_width, view.frame.scale), canvas(std::move(begun)) {}

ViewOnCanvas::ViewOnCanvas(View view_, const Style& style, int reference_width)
    : ViewOnCanvas(view_, style, reference_width, canvas_of(view_, style)) {}

LayerPlan make_layer_plan(const ViewOnCanvas& at, const Style& style, int layer, LayerFit* fit) {
  constexpr float no_threshold_px = 1e9f, fine_px = 5;
  const float radius = at.scaled.radii_px[layer];
  const float threshold = style.depth_test ? at.scaled.depth_threshold_px : no_threshold_px;
  const bool finest = layer + 1 == static_cast<int>(at.scaled.radii_px.size());
  LayerPlan plan{.style = style,
                 .view = at.view,
                 .canvas = at.begun(),
                 .radius_px = radius,
                 .layer = layer,
                 .seeds = at.view.wanted,
                 .beside = at.beside,
                 // Broad strokes are few: they may gain less, so that soft gradients show fewer steps.
                 .least_gain = at.scaled.least_gain * std::min(fine_px / radius, 1.f),
                 .fit = fit,
                 .depth_threshold_px = threshold};
  if (at.view.continued) plan.least_edge_cell_px = 3;  // edges that no photograph shows need no detail
  tbb::parallel_invoke([&] { plan.reference = reference_for(at.view.colour, radius, style, fit); },
                       [&] {
                         if (!style.depth_test) return;
                         const Image<std::int16_t> steps = disparity_in_steps(at.view.disparity);
                         plan.depth_edges = near_depth_edge(steps, radius, threshold);
                         if (!finest) return;
                         plan.edge_distance = distance_to_depth_edge(steps, threshold, radius + known_edge_distance_px);
                         // Strokes begin where two surfaces' colours mix only if there is no other place, because the
                         // surfaces separate in other views. A part of a view needs no such mask: no other view sees
                         // it.
                         if (at.view.wanted.empty())
                           plan.mixed_colours = behind_depth_edge(steps, radius / 2, threshold);
                       });
  return plan;
}

Image<std::uint8_t> misplaced_paint(const ViewOnCanvas& at, const Style& style) {
  if (style.jitter != ColourJitter{}) return {};
  return residual(picture_of(at.begun()), at.view.colour);
}

std::vector<Layer> plan_alone(ViewOnCanvas& at, const Style& style, const Progress& progress) {
  std::vector<Layer> planned;
  const int layers = static_cast<int>(at.scaled.radii_px.size());
  for (int i = 0; i < layers; ++i) {
    report(progress, "painting", static_cast<double>(i) / layers);
    LayerPlan plan = make_layer_plan(at, style, i);
    const bool finest = i + 1 == layers;
    const Image<std::uint8_t> misplaced = finest ? misplaced_paint(at, style) : Image<std::uint8_t>();
    plan.misplaced = misplaced;
    Layer layer = plan_layer(plan);
    if (style.marks == Marks::strokes) sort_far_to_near(layer, hash_keys({style.seed, static_cast<std::uint64_t>(i)}));
    if (!finest)
      rasterise(layer, at.view.position, {.surface = at.view.disparity, .tolerance_px = at.scaled.depth_threshold_px},
                at.canvas);
    hand_back(at.view.frame, layer);
    planned.push_back(std::move(layer));
  }
  report(progress, "painting", 1);
  return planned;
}

}  // namespace wheatstone
