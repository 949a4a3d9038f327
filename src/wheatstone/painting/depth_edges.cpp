#include "wheatstone/painting/depth_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

/// Marks the pixels for which `test(own, nearest, farthest)` holds, the last two over the square window of `reach_px`
/// around the pixel.
template <class Test>
Image<std::uint8_t> mark_by_window(ImageView<const float> disparity, float reach_px, Test test) {
  const int reach = static_cast<int>(std::ceil(reach_px));
  const int height = disparity.height();
  const cv::Mat source = as_mat(disparity);
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
  Image<std::uint8_t> marks(disparity.width(), height);

  const int band_rows = std::max(64, 2 * reach);
  tbb::parallel_for(0, (height + band_rows - 1) / band_rows, [&](int band) {
    const int first = band * band_rows;
    const int last = std::min(first + band_rows, height);
    // OpenCV looks at the rows around a part of a matrix, so bands do not change the result.
    const cv::Mat rows = source.rowRange(first, last);
    cv::Mat nearest, farthest;
    cv::dilate(rows, nearest, window);
    cv::erode(rows, farthest, window);
    for (int y = first; y < last; ++y) {
      const float* high = nearest.ptr<float>(y - first);
      const float* low = farthest.ptr<float>(y - first);
      const auto own = disparity.row(y);
      const auto to = marks.row(y);
      for (int x = 0; x < disparity.width(); ++x) to[x] = test(own[x], high[x], low[x]) ? 255 : 0;
    }
  });
  return marks;
}

}  // namespace

Image<std::uint8_t> near_depth_edge(ImageView<const float> disparity, float radius_px, float threshold_px) {
  return mark_by_window(disparity, radius_px, [=](float own, float nearest, float farthest) {
    return std::max(nearest - own, own - farthest) > threshold_px;
  });
}

Image<float> distance_to_depth_edge(ImageView<const float> disparity, float threshold_px) {
  const Image<std::uint8_t> edges = near_depth_edge(disparity, 1, threshold_px);
  Image<float> distance(disparity.width(), disparity.height());
  cv::Mat target = as_mat(distance);
  cv::distanceTransform(as_mat(edges) == 0, target, cv::DIST_L2, 3);
  target += 0.5;
  return distance;
}

Image<std::uint8_t> behind_depth_edge(ImageView<const float> disparity, float reach_px, float threshold_px) {
  return mark_by_window(disparity, reach_px,
                        [=](float own, float nearest, float) { return nearest - own > threshold_px; });
}

}  // namespace wheatstone
