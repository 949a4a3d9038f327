#include "wheatstone/strokes/depth_edges_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

/// Disparities are compared in sixteenths of a pixel: that is as fine as matching gets, and half the work of floats.
constexpr float steps_a_px = 16;

/// Calls `work(first_row, end_row)` for bands of rows of a picture, in parallel.
template <class Work>
void for_each_band(int height, int band_rows, Work work) {
  tbb::parallel_for(0, (height + band_rows - 1) / band_rows,
                    [&](int band) { work(band * band_rows, std::min((band + 1) * band_rows, height)); });
}

/// Marks the pixels for which `test(own, nearest, farthest)` holds, the last two over the square window of `reach_px`
/// around the pixel, all in steps.
template <class Test>
Image<std::uint8_t> mark_by_window(ImageView<const std::int16_t> steps, float reach_px, Test test) {
  const int reach = static_cast<int>(std::ceil(reach_px));
  const cv::Mat source = as_mat(steps);
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
  Image<std::uint8_t> marks(steps.width(), steps.height());
  for_each_band(steps.height(), std::max(64, 2 * reach), [&](int first, int end) {
    // OpenCV looks at the rows around a part of a matrix, so bands do not change the result.
    const cv::Mat rows = source.rowRange(first, end);
    cv::Mat nearest, farthest;
    cv::dilate(rows, nearest, window);
    cv::erode(rows, farthest, window);
    for (int y = first; y < end; ++y) {
      const auto* high = nearest.ptr<std::int16_t>(y - first);
      const auto* low = farthest.ptr<std::int16_t>(y - first);
      const auto own = steps.row(y);
      const auto to = marks.row(y);
      for (int x = 0; x < steps.width(); ++x) to[x] = test(own[x], high[x], low[x]) ? 255 : 0;
    }
  });
  return marks;
}

int threshold_in_steps(float threshold_px) { return static_cast<int>(threshold_px * steps_a_px); }

}  // namespace

Image<std::int16_t> disparity_in_steps(ImageView<const float> disparity) {
  Image<std::int16_t> steps(disparity.width(), disparity.height());
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto from = disparity.row(y);
    const auto to = steps.row(y);
    for (int x = 0; x < disparity.width(); ++x)
      to[x] = static_cast<std::int16_t>(
          static_cast<int>(std::max(std::min(from[x] * steps_a_px + std::copysign(0.5f, from[x]), 32767.f), -32767.f)));
  });
  return steps;
}

Image<std::uint8_t> near_depth_edge(ImageView<const std::int16_t> steps, float radius_px, float threshold_px) {
  const int threshold = threshold_in_steps(threshold_px);
  return mark_by_window(steps, radius_px, [=](int own, int nearest, int farthest) {
    return std::max(nearest - own, own - farthest) > threshold;
  });
}

Image<float> distance_to_depth_edge(ImageView<const std::int16_t> steps, float threshold_px, float most_px) {
  const Image<std::uint8_t> edges = near_depth_edge(steps, 1, threshold_px);
  const int width = steps.width(), height = steps.height();
  const int reach = static_cast<int>(std::ceil(most_px));
  Image<float> distance(width, height, most_px);
  const int tile = std::max(64, 4 * reach);
  for_each_band(height, tile, [&](int first, int end) {
    // Edges farther away than `most_px` do not matter, so each tile need only see that far.
    const int top = std::max(first - reach, 0), bottom = std::min(end + reach, height);
    for (int begin = 0; begin < width; begin += tile) {
      const int left = std::max(begin - reach, 0), right = std::min(begin + tile + reach, width);
      const cv::Mat seen = as_mat(edges)(cv::Range(top, bottom), cv::Range(left, right));
      if (cv::countNonZero(seen) == 0) continue;
      cv::Mat found;
      cv::distanceTransform(seen == 0, found, cv::DIST_L2, 3);
      for (int y = first; y < end; ++y) {
        const float* from = found.ptr<float>(y - top);
        const auto to = distance.row(y);
        for (int x = begin; x < std::min(begin + tile, width); ++x) to[x] = std::min(from[x - left] + 0.5f, most_px);
      }
    }
  });
  return distance;
}

Image<std::uint8_t> behind_depth_edge(ImageView<const std::int16_t> steps, float reach_px, float threshold_px) {
  const int threshold = threshold_in_steps(threshold_px);
  return mark_by_window(steps, reach_px, [=](int own, int nearest, int) { return nearest - own > threshold; });
}

}  // namespace wheatstone
