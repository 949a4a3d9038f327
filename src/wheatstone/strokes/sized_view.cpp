#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/outer_view.h"
#include "wheatstone/strokes/sized_view_internal.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {
namespace {

int least_reduction_for(const SceneView& view, float finest_radius_px) {
  constexpr int least = 2, most = 8;
  // What only views between the eyes show are slits, which need less detail.
  const bool is_between = view.position > left_eye && view.position < right_eye;
  const float least_radius_px = is_between ? 0.75f : 1.5f;
  int reduction = least;
  while (view.continued && reduction < most && finest_radius_px >= least_radius_px * static_cast<float>(2 * reduction))
    reduction *= 2;
  return reduction;
}

/// What a view alone shows, grown, `reduction` times smaller than the reference view.
ReducedView grown_part(const SceneView& view, float growth_px, int reduction, const SceneView& reference) {
  const auto grown_in = [&](ImageView<const std::uint8_t> part, int part_reduction) {
    return dilate_occlusion(part, static_cast<int>(std::lround(growth_px / static_cast<float>(part_reduction))));
  };
  if (view.reduction <= reduction) {
    const int left_out_px = view.reduction > 1 ? 1 : 2;  // a pixel of a smaller picture stands for several already
    return reduced(view.picture, view.disparity, grown_in(view.only_here, view.reduction), reduction / view.reduction,
                   left_out_px);
  }
  OuterView larger = enlarged(view, view.reduction / reduction, reference.picture.width() / reduction,
                              reference.picture.height() / reduction);
  return {.photograph = std::move(larger.picture),
          .disparity = std::move(larger.disparity),
          .seeds = grown_in(larger.uncovered, reduction)};
}

}  // namespace

WantedPart wanted_part(const SceneView& view, const SceneView& reference, const Style& style, bool scene_begins) {
  const int width = reference.picture.width();
  if (view.only_here.empty()) return {view, width, {}};
  const ScaledStyle scaled(style, width);
  const int reduction = least_reduction_for(view, scaled.radii_px.back());
  if (scene_begins) {
    const float growth_px = style.occlusion_dilation * scaled.radii_px.front();
    return {view, width, grown_part(view, growth_px, reduction, reference), reduction};
  }
  Image<std::uint8_t> alone(view.picture.width(), view.picture.height());
  tbb::parallel_for(0, alone.height(), [&](int y) {
    for (int x = 0; x < alone.width(); ++x) {
      if (view.only_here(x, y) == 0) continue;
      const ControlPoint point{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, view.disparity(x, y)};
      const float column = column_in(point, view, reference);
      const bool is_in_picture = column >= 0 && column < static_cast<float>(alone.width());
      alone(x, y) = is_in_picture && is_visible(point, view, reference, scaled.depth_threshold_px) ? 0 : 255;
    }
  });
  return {view, width, reduced(view.picture, view.disparity, alone, reduction), reduction};
}

namespace {

/// What is on a smaller canvas, on one of another size; what the smaller picture left out at the border is as beside
/// it.
Canvas enlarged(const Canvas& smaller, int factor, int width, int height) {
  Canvas canvas(width, height, {});
  const auto enlarge = [&](const Image<float>& from, Image<float>& to) {
    const cv::Mat small = as_mat(from).colRange(0, smaller.width);
    const int columns = std::min(smaller.width * factor, width), rows = std::min(smaller.height * factor, height);
    const cv::Mat all = as_mat(to);
    cv::Mat large = all(cv::Rect(0, 0, smaller.width * factor, smaller.height * factor));
    cv::resize(small, large, large.size(), 0, 0, cv::INTER_LINEAR);
    for (int x = columns; x < width; ++x) all.col(columns - 1).copyTo(all.col(x));
    for (int y = rows; y < height; ++y) all.row(rows - 1).copyTo(all.row(y));
  };
  tbb::parallel_invoke([&] { enlarge(smaller.red, canvas.red); }, [&] { enlarge(smaller.green, canvas.green); },
                       [&] { enlarge(smaller.blue, canvas.blue); },
                       [&] { enlarge(smaller.coverage, canvas.coverage); });
  return canvas;
}

LayerPlanner planner_of(const WantedPart& part, const std::optional<ReducedView>& smaller, const Style& style,
                        const SizedView* before, int factor) {
  const ImageView<const Rgb8> photograph = smaller ? smaller->photograph.view() : part.photograph();
  const ImageView<const float> disparity = smaller ? smaller->disparity.view() : part.disparity();
  if (before == nullptr) return {photograph, disparity, part.view.position, style};
  return {photograph, disparity, part.view.position, style,
          enlarged(before->planner.canvas, before->factor / factor, photograph.width(), photograph.height())};
}

}  // namespace

SizedView::SizedView(const WantedPart& part_, const Style& style, int factor_, const SizedView* before)
    : part(part_),
      factor(factor_),
      reduction(part.reduction * factor),
      smaller(factor > 1 ? std::optional(reduced(part.photograph(), part.disparity(), part.seeds(), factor))
                         : std::nullopt),
      scaled(style, part.width, static_cast<float>(reduction)),
      planner(planner_of(part, smaller, style, before, factor)) {
  planner.avoid_mixed_colours = part.is_whole();  // no other eye sees those of a part
  planner.beside = part.beside;
  if (reduction > 1) planner.least_dot_px = 0.6f;           // little wider than the pixel, which is several
  if (part.view.continued) planner.least_edge_cell_px = 3;  // of what no photograph shows, edges need no detail
}

int factor_for_layer(const WantedPart& part, float radius_px, float least_radius_px) {
  constexpr int least_side_px = 16;
  const int side_px = std::min(part.photograph().width(), part.photograph().height());
  const auto fits = [&](int factor) {
    return radius_px >= least_radius_px * static_cast<float>(factor * part.reduction) &&
           side_px >= least_side_px * factor;
  };
  int factor = 1;
  while (fits(2 * factor)) factor *= 2;
  return factor;
}

}  // namespace wheatstone
