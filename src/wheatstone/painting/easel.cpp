#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <optional>

#include "wheatstone/painting/depth_edges_internal.h"
#include "wheatstone/painting/easel_internal.h"
#include "wheatstone/painting/layer_order_internal.h"
#include "wheatstone/painting/plan_layer_internal.h"
#include "wheatstone/painting/rasterise.h"
#include "wheatstone/painting/reference_picture_internal.h"
#include "wheatstone/random.h"

namespace wheatstone {

ScaledStyle::ScaledStyle(const Style& style, int width, float reduction)
    : depth_threshold_px(style.depth_threshold_px * style_scale(style, width) / reduction) {
  constexpr float least_px = 1;
  for (const float radius : style.radii_px)
    radii_px.push_back(std::max(radius * style_scale(style, width), least_px) / reduction);
}

Easel::Easel(ImageView<const Rgb8> photograph_, ImageView<const float> disparity_, float view_, const Style& style)
    : photograph(photograph_),
      disparity(disparity_),
      view(view_),
      canvas(style.background == Background::photograph
                 ? make_canvas(photograph)
                 : Canvas(photograph.width(), photograph.height(), style.canvas_colour)) {}

namespace {

/// What the depth test of one layer looks at.
struct DepthTest {
  DepthTest(const Easel& easel, float radius_px, float threshold_px, bool finest)
      : edges(near_depth_edge(easel.disparity, radius_px, threshold_px)) {
    if (!finest) return;
    distance = distance_to_depth_edge(easel.disparity, threshold_px, radius_px + 1);
    if (easel.avoid_mixed_colours) mixed_colours = behind_depth_edge(easel.disparity, radius_px / 2, threshold_px);
  }
  Image<std::uint8_t> edges, mixed_colours;
  Image<float> distance;
};

}  // namespace

Layer plan_on(const Easel& easel, const Style& style, const ScaledStyle& scaled, int layer,
              ImageView<const std::uint8_t> seeds) {
  const float radius = scaled.radii_px[layer];
  const bool finest = layer + 1 == static_cast<int>(scaled.radii_px.size());
  ReferencePicture reference;
  std::optional<DepthTest> depth;
  tbb::parallel_invoke([&] { reference = make_reference(easel.photograph, radius, style); },
                       [&] {
                         if (style.depth_test) depth.emplace(easel, radius, scaled.depth_threshold_px, finest);
                       });
  LayerPlan plan{.reference = reference,
                 .canvas = easel.canvas,
                 .disparity = easel.disparity,
                 .seeds = seeds,
                 .view = easel.view,
                 .radius_px = radius,
                 .layer = layer,
                 .depth_threshold_px = scaled.depth_threshold_px};
  if (depth) {
    plan.depth_edges = depth->edges;
    plan.edge_distance = depth->distance;
    plan.mixed_colours = depth->mixed_colours;
  }
  return plan_layer(plan, style);
}

void order_strokes(Layer& strokes, const Style& style, int layer) {
  sort_far_to_near(strokes, hash({style.seed, static_cast<std::uint64_t>(layer)}));
}

Painting plan_alone(Easel& easel, const Style& style, const ScaledStyle& scaled, ImageView<const std::uint8_t> seeds,
                    const Progress& progress) {
  Painting painting{easel.canvas.width, easel.canvas.height, style.canvas_colour, {}};
  const int layers = static_cast<int>(scaled.radii_px.size());
  for (int i = 0; i < layers; ++i) {
    report(progress, "painting", static_cast<double>(i) / layers);
    painting.layers.push_back(plan_on(easel, style, scaled, i, seeds));
    order_strokes(painting.layers.back(), style, i);
    if (i + 1 < layers) rasterise(painting.layers.back(), easel.view, easel.canvas);
  }
  report(progress, "painting", 1);
  return painting;
}

}  // namespace wheatstone
