#include "wheatstone/painting/paint.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "wheatstone/error.h"
#include "wheatstone/painting/canvas.h"
#include "wheatstone/painting/depth_edges.h"
#include "wheatstone/painting/layer_order.h"
#include "wheatstone/painting/plan_layer.h"
#include "wheatstone/painting/propagate.h"
#include "wheatstone/painting/random.h"
#include "wheatstone/painting/rasterise.h"
#include "wheatstone/painting/reference_picture.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/warp.h"

namespace wheatstone {
namespace {

/// Adds the time until it goes out of scope.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

/// The style's lengths in pixels of the picture at hand.
struct ScaledStyle {
  ScaledStyle(const Style& style, int width) : depth_threshold_px(style.depth_threshold_px * style_scale(style, width)) {
    for (const float radius : style.radii_px) radii_px.push_back(std::max(radius * style_scale(style, width), 1.f));
  }
  std::vector<float> radii_px;
  float depth_threshold_px;
};

/// One eye at work: what it sees, and the canvas that its next layer is planned against.
struct Easel {
  Easel(ImageView<const Rgb8> photograph_, ImageView<const float> disparity_, float view_, const Style& style)
      : photograph(photograph_),
        disparity(disparity_),
        view(view_),
        canvas(style.background == Background::photograph
                   ? make_canvas(photograph)
                   : Canvas(photograph.width(), photograph.height(), style.canvas_colour)) {}

  ImageView<const Rgb8> photograph;
  ImageView<const float> disparity;
  float view;
  Canvas canvas;
};

/// What the depth test of one layer looks at.
struct DepthTest {
  DepthTest(const Easel& easel, float radius_px, float threshold_px, bool finest)
      : edges(near_depth_edge(easel.disparity, radius_px, threshold_px)) {
    if (!finest) return;
    distance = distance_to_depth_edge(easel.disparity, threshold_px);
    mixed_colours = behind_depth_edge(easel.disparity, radius_px / 2, threshold_px);
  }
  Image<std::uint8_t> edges, mixed_colours;
  Image<float> distance;
};

Layer plan(const Easel& easel, const Style& style, const ScaledStyle& scaled, int layer,
           ImageView<const std::uint8_t> seeds = {}) {
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

void order(Layer& layer, const Style& style, int number) {
  sort_far_to_near(layer, hash({style.seed, static_cast<std::uint64_t>(number)}));
}

/// Draws the finished painting for one eye, over what the style wants behind it.
DrawnView draw_for(const Easel& easel, const Painting& painting, const Style& style) {
  return draw(painting, easel.view,
              style.background == Background::photograph ? easel.photograph : ImageView<const Rgb8>());
}

/// Plans all layers of one eye alone, from seeds everywhere or on a mask.
Painting plan_alone(Easel& easel, const Style& style, const ScaledStyle& scaled, ImageView<const std::uint8_t> seeds,
                    PaintingTimes& times, const Progress& progress) {
  const Stopwatch watch(times.planning_s);
  Painting painting{easel.canvas.width, easel.canvas.height, style.canvas_colour, {}};
  const int layers = static_cast<int>(scaled.radii_px.size());
  for (int i = 0; i < layers; ++i) {
    report(progress, "painting", static_cast<double>(i) / layers);
    painting.layers.push_back(plan(easel, style, scaled, i, seeds));
    order(painting.layers.back(), style, i);
    if (i + 1 < layers) rasterise(painting.layers.back(), easel.view, easel.canvas);
  }
  report(progress, "painting", 1);
  return painting;
}

Image<std::uint8_t> dilated(const Image<std::uint8_t>& occlusion, const Style& style, const ScaledStyle& scaled) {
  return dilate_occlusion(occlusion, static_cast<int>(std::lround(style.occlusion_dilation * scaled.radii_px.front())));
}

/// Stavrakis & Gelautz 2005, sec. 3.2: each layer is planned in the left eye and carried to the right; what only the
/// right eye sees is planned there, against a canvas that holds nothing else, and carried back.
Painting plan_with_strokes(Easel& left, Easel& right, const StereoGeometry& geometry, const Style& style,
                           const ScaledStyle& scaled, const Progress& progress) {
  const Image<std::uint8_t> right_seeds = dilated(geometry.right_occlusion, style, scaled);
  Painting painting{left.canvas.width, left.canvas.height, style.canvas_colour, {}};
  const int layers = static_cast<int>(scaled.radii_px.size());
  for (int i = 0; i < layers; ++i) {
    report(progress, "painting", static_cast<double>(i) / layers);
    Layer layer, from_right;
    tbb::parallel_invoke(
        [&] { layer = propagate_to_other_eye(plan(left, style, scaled, i), geometry.left_occlusion); },
        [&] {
          from_right = propagate_to_other_eye(plan(right, style, scaled, i, right_seeds), geometry.right_occlusion);
        });
    append_strokes(from_right, layer);
    order(layer, style, i);
    order(from_right, style, i);
    if (i + 1 < layers) {
      tbb::parallel_invoke([&] { rasterise(layer, left.view, left.canvas); },
                           [&] { rasterise(from_right, right.view, right.canvas); });
    }
    painting.layers.push_back(std::move(layer));
  }
  report(progress, "painting", 1);
  return painting;
}

/// Layers of two paintings of one size and style, one behind the other.
Painting joined(Painting left, const Painting& right) {
  for (std::size_t i = 0; i < left.layers.size(); ++i) append_strokes(right.layers[i], left.layers[i]);
  return left;
}

void draw_both(const Easel& left, const Easel& right, const Style& style, PaintedPair& result) {
  const Stopwatch watch(result.times.rasterising_s);
  DrawnView left_view = draw_for(left, result.painting, style);
  DrawnView right_view = draw_for(right, result.painting, style);
  result.pictures = {std::move(left_view.picture), std::move(right_view.picture)};
  result.left_bare_share = left_view.bare_share;
  result.right_bare_share = right_view.bare_share;
}

PaintedPair paint_with_strokes(Easel& left, Easel& right, const StereoGeometry& geometry, const Style& style,
                               const Progress& progress) {
  PaintedPair result;
  {
    const Stopwatch watch(result.times.planning_s);
    result.painting = plan_with_strokes(left, right, geometry, style, ScaledStyle(style, left.canvas.width), progress);
  }
  draw_both(left, right, style, result);
  return result;
}

/// Stavrakis & Gelautz 2004, sec. 3.2: the left eye is painted; the right eye is painted where only it sees, and the
/// left picture is warped over that. The few pixels that neither reaches show the photograph.
PaintedPair paint_with_raster(Easel& left, Easel& right, const StereoGeometry& geometry, const Style& style,
                              const Progress& progress) {
  const ScaledStyle scaled(style, left.canvas.width);
  const Image<std::uint8_t> right_seeds = dilated(geometry.right_occlusion, style, scaled);
  PaintedPair result;
  Painting right_painting;
  result.painting = plan_alone(left, style, scaled, {}, result.times, progress);
  right_painting = plan_alone(right, style, scaled, right_seeds, result.times, progress);
  result.painting = joined(std::move(result.painting), right_painting);
  draw_both(left, right, style, result);

  const Stopwatch watch(result.times.rasterising_s);
  const WarpedPicture warped = warp_picture(result.pictures.left, geometry.left_disparity, Eye::left);
  lay_over(warped, result.pictures.right);
  result.right_bare_share = 0;
  return result;
}

PaintedPair paint_each_alone(Easel& left, Easel& right, const Style& style, const Progress& progress) {
  const ScaledStyle scaled(style, left.canvas.width);
  PaintedPair result;
  const Painting left_painting = plan_alone(left, style, scaled, {}, result.times, progress);
  const Painting right_painting = plan_alone(right, style, scaled, {}, result.times, progress);
  result.painting = joined(left_painting, right_painting);
  draw_both(left, right, style, result);
  return result;
}

void check_fits(const StereoPair& photographs, const StereoGeometry& geometry) {
  const auto check = [&](const auto& image, std::string_view name) {
    if (!same_size(image, photographs.left))
      throw Error(ErrorKind::bad_input, fmt::format("{} is {}x{} pixels, expected the photographs' {}x{}", name,
                                                    image.width(), image.height(), photographs.left.width(),
                                                    photographs.left.height()));
  };
  if (photographs.left.empty()) throw Error(ErrorKind::bad_input, "the left picture has no pixels");
  check(photographs.right, "the right picture");
  check(geometry.left_disparity, "the left disparity");
  check(geometry.right_disparity, "the right disparity");
  check(geometry.left_occlusion, "the left occlusion mask");
  check(geometry.right_occlusion, "the right occlusion mask");
  for (const Image<float>* disparity : {&geometry.left_disparity, &geometry.right_disparity})
    for (const float value : disparity->pixels())
      if (!std::isfinite(value)) throw Error(ErrorKind::bad_input, "the disparity has unknown pixels, expected none");
}

}  // namespace

PaintedPair paint(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style,
                  const Progress& progress) {
  check_style(style);
  check_fits(photographs, geometry);
  Easel left(photographs.left, geometry.left_disparity, left_eye, style);
  Easel right(photographs.right, geometry.right_disparity, right_eye, style);
  switch (style.propagation) {
    case Propagation::strokes: return paint_with_strokes(left, right, geometry, style, progress);
    case Propagation::raster: return paint_with_raster(left, right, geometry, style, progress);
    case Propagation::independent: break;
  }
  return paint_each_alone(left, right, style, progress);
}

PaintedView paint_view(ImageView<const Rgb8> photograph, ImageView<const float> disparity, float view,
                       const Style& style, const Progress& progress) {
  check_style(style);
  Easel easel(photograph, disparity, view, style);
  PaintedView result;
  result.painting = plan_alone(easel, style, ScaledStyle(style, photograph.width()), {}, result.times, progress);
  const Stopwatch watch(result.times.rasterising_s);
  DrawnView drawn = draw_for(easel, result.painting, style);
  result.picture = std::move(drawn.picture);
  result.bare_share = drawn.bare_share;
  return result;
}

}  // namespace wheatstone
