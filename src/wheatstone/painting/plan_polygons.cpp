#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/painting/fitting_pair_internal.h"
#include "wheatstone/painting/fitting_scene_internal.h"
#include "wheatstone/painting/plan_polygons_internal.h"
#include "wheatstone/random.h"
#include "wheatstone/stereo/occlusion.h"

namespace wheatstone {
namespace {

void sort_far_to_near(PolygonPainting& painting) {
  const auto key = [](const PolygonMark& mark) {
    return std::tuple(mark.views == ViewRange{}, std::lround(mark.disparity));
  };
  std::ranges::stable_sort(painting.marks, {}, key);
}

}  // namespace

PolygonPainting plan_polygons(std::span<const SceneView> views, const Style& style, const CutView& cut) {
  check_style(style);
  check_fits(views);
  const int width = views[0].picture.width();
  const float scale = style_scale(style, width);
  const bool independent = style.propagation == Propagation::independent;
  PolygonPainting painting{width, views[0].picture.height(), {}, {}, {}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SceneView& view = views[i];
    const Image<float> disparity = without_outliers(view.disparity);
    ViewToCut to_cut{.photograph = view.picture,
                     .disparity = disparity,
                     .mask = {},
                     .number = i,
                     .view = view.position,
                     .views = {},
                     .seed = style.seed,
                     .scale = scale,
                     .depth_threshold_px = style.depth_threshold_px * scale};
    if (i > 0 || independent) to_cut.views = {view.position, view.position};
    if (i > 0 && independent) to_cut.seed = hash({style.seed, i});
    Image<std::uint8_t> only_here;
    if (i > 0 && !independent && !view.only_here.empty()) {
      // Grown, so that the marks reach under those of the reference view.
      constexpr float overlap_px = 3;
      only_here = dilate_occlusion(view.only_here, static_cast<int>(std::ceil(overlap_px * scale)));
      to_cut.mask = only_here;
    }
    cut(to_cut, style, painting);
  }
  std::erase_if(painting.marks, [](const PolygonMark& mark) { return mark.ring_count == 0; });
  sort_far_to_near(painting);
  return painting;
}

PolygonPainting plan_polygons(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style,
                              const CutView& cut) {
  check_style(style);
  check_fits(photographs, geometry);
  return plan_polygons(scene_from_left(photographs, geometry), style, cut);
}

Image<Rgb8> without_grain(ImageView<const Rgb8> photograph, float scale) {
  Image<Rgb8> smooth(photograph.width(), photograph.height()), result(photograph.width(), photograph.height());
  constexpr double colour_reach = 35;
  const double reach_px = 3 * std::max(static_cast<double>(scale), 0.5);
  const int kernel = 2 * static_cast<int>(std::lround(1.5 * reach_px)) + 1;
  cv::Mat first = as_mat(smooth), second = as_mat(result);
  cv::bilateralFilter(as_mat(photograph), first, kernel, colour_reach, reach_px);
  cv::bilateralFilter(first, second, kernel, colour_reach, reach_px);
  return result;
}

Image<Rgb8> without_grain_quickly(ImageView<const Rgb8> photograph) {
  Image<Rgb8> result(photograph.width(), photograph.height());
  cv::Mat to = as_mat(result);
  constexpr int kernel = 5;
  cv::medianBlur(as_mat(photograph), to, kernel);
  return result;
}

Image<float> without_outliers(ImageView<const float> disparity) {
  Image<float> result(disparity.width(), disparity.height());
  cv::Mat to = as_mat(result);
  constexpr int kernel = 5;
  cv::medianBlur(as_mat(disparity), to, kernel);
  return result;
}

}  // namespace wheatstone
