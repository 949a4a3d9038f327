#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/painting/fitting_pair_internal.h"
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

PolygonPainting plan_polygons(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style,
                              const CutView& cut) {
  check_style(style);
  check_fits(photographs, geometry);
  const int width = photographs.left.width();
  const float scale = style_scale(style, width);
  const Image<float> left_disparity = without_outliers(geometry.left_disparity);
  const Image<float> right_disparity = without_outliers(geometry.right_disparity);
  ViewToCut left{.photograph = photographs.left,
                 .disparity = left_disparity,
                 .mask = {},
                 .colours_from = photographs.left,
                 .view = left_eye,
                 .views = {},
                 .seed = style.seed,
                 .scale = scale,
                 .depth_threshold_px = style.depth_threshold_px * scale};
  ViewToCut right = left;
  right.photograph = photographs.right;
  right.disparity = right_disparity;
  right.view = right_eye;
  right.views = {right_eye, right_eye};
  Image<std::uint8_t> right_only;
  if (style.propagation == Propagation::independent) {
    left.views = {left_eye, left_eye};
    right.colours_from = photographs.right;
    right.seed = hash({style.seed, 1});
  } else {
    // Grown, so that the marks reach under those of the left eye.
    constexpr float overlap_px = 3;
    right_only = dilate_occlusion(geometry.right_occlusion, static_cast<int>(std::ceil(overlap_px * scale)));
    right.mask = right_only;
  }
  PolygonPainting painting{width, photographs.left.height(), {}, {}, {}};
  cut(right, style, painting);
  cut(left, style, painting);
  std::erase_if(painting.marks, [](const PolygonMark& mark) { return mark.ring_count == 0; });
  sort_far_to_near(painting);
  return painting;
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

Image<float> without_outliers(ImageView<const float> disparity) {
  Image<float> result(disparity.width(), disparity.height());
  cv::Mat to = as_mat(result);
  constexpr int kernel = 5;
  cv::medianBlur(as_mat(disparity), to, kernel);
  return result;
}

}  // namespace wheatstone
