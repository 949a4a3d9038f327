#include "wheatstone/curves/plan_diffusion.h"

#include <tbb/parallel_for.h>

#include "wheatstone/curves/diffusion_lines_internal.h"
#include "wheatstone/image/grain.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/stereo/occlusion.h"

namespace wheatstone {
namespace {

void append(const DiffusionPainting& part, DiffusionPainting& whole) {
  const auto first = static_cast<std::uint32_t>(whole.points.size());
  whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
  for (ColourLine line : part.lines) {
    line.first_point += first;
    whole.lines.push_back(line);
  }
}

/// Each view planned as if it were the only one.
DiffusionPainting plan_each_alone(const SceneOfEdges& scene) {
  DiffusionPainting painting{scene.views[0].colour.width(), scene.views[0].colour.height(), {}, {}};
  for (const View& view : scene.views) {
    DiffusionPainting part = lines_beside_edges({{view}, scene.depth_threshold_px}, nullptr).painting;
    for (ColourLine& line : part.lines) line.views = {view.position, view.position};
    append(part, painting);
  }
  return painting;
}

}  // namespace

SceneOfEdges scene_of_edges(std::span<const View> views, const Style& style) {
  check_style(style);
  check_fits(views);
  const float scale = style_scale(style, views[0].colour.width());
  SceneOfEdges scene{std::vector<View>(views.size()), style.depth_threshold_px * scale};
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    View& view = scene.views[i] = views[i];
    view.colour = without_grain(view.colour, scale);
    view.disparity = without_outliers(view.disparity);
    if (!view.wanted.empty()) view.wanted = dilate_occlusion(view.wanted, 1);
  });
  return scene;
}

DiffusionPainting plan_diffusion(std::span<const View> views, const Style& style) {
  const SceneOfEdges scene = scene_of_edges(views, style);
  if (style.propagation == Propagation::independent) return plan_each_alone(scene);
  return lines_beside_edges(scene, nullptr).painting;
}

}  // namespace wheatstone
