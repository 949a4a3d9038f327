#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/calibration/rectifying_map_internal.h"
#include "wheatstone/calibration/warp_picture_internal.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {

cv::Rect largest_rectangle_within(const cv::Mat& mask) {
  cv::Rect best;
  std::vector<int> reach(static_cast<std::size_t>(mask.cols) + 1, 0);  // filled pixels upwards; a last column of none
  std::vector<std::pair<int, int>> open;  // rectangles that still grow to the right: first column, height
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x) reach[x] = row[x] != 0 ? reach[x] + 1 : 0;
    open.clear();
    for (int x = 0; x <= mask.cols; ++x) {
      int first = x;
      while (!open.empty() && open.back().second >= reach[x]) {
        const auto [begin, height] = open.back();
        open.pop_back();
        first = begin;
        const cv::Rect found(begin, y - height + 1, x - begin, height);
        if (static_cast<std::int64_t>(found.width) * found.height > static_cast<std::int64_t>(best.width) * best.height)
          best = found;
      }
      if (reach[x] > 0) open.emplace_back(first, reach[x]);
    }
  }
  return best;
}

namespace {

bool covers(const RectifyingMap& map, const cv::Matx33d& back, PicturePoint place) {
  const PicturePoint there = photograph_place(map, back, place);
  return there.x >= 0 && there.y >= 0 && there.x <= map.width && there.y <= map.height;
}

/// Where the pixels of a row are in the photograph, as OpenCV counts: from the centre of the first pixel. Places a
/// 250th of the photograph apart lie on a line, to less than a hundredth of a pixel with lenses as bent as any.
void find_places(const RectifyingMap& map, const cv::Matx33d& back, int y, std::span<cv::Vec2f> places) {
  const int step = std::clamp(std::max(map.width, map.height) / 250, 1, 8);
  const int width = static_cast<int>(places.size());
  const auto place_at = [&](int x) {
    const PicturePoint there = photograph_place(map, back, {x + 0.5, y + 0.5});
    return cv::Vec2d(there.x - 0.5, there.y - 0.5);
  };
  cv::Vec2d next = place_at(0);
  for (int begin = 0; begin < width; begin += step) {
    const cv::Vec2d here = next;
    next = place_at(begin + step);
    const cv::Vec2d slope = (next - here) / step;
    for (int x = begin; x < std::min(begin + step, width); ++x) places[x] = here + slope * (x - begin);
  }
}

template <class Pixel>
Image<Pixel> warp(ImageView<const Pixel> photograph, const RectifyingMap& map, cv::Size size) {
  Image<Pixel> result(size.width, size.height);
  const cv::Mat from = as_mat(photograph);
  cv::Mat to = as_mat(result);
  const cv::Matx33d back = cv::Matx33d(map.homography.data()).inv();
  constexpr int band_rows = 32;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, size.height, band_rows), [&](const auto& rows) {
    cv::Mat places(rows.end() - rows.begin(), size.width, CV_32FC2);
    for (int y = rows.begin(); y < rows.end(); ++y)
      find_places(map, back, y, {places.ptr<cv::Vec2f>(y - rows.begin()), static_cast<std::size_t>(size.width)});
    cv::Mat band = to.rowRange(rows.begin(), rows.end());
    cv::remap(from, band, places, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  });
  return result;
}

}  // namespace

Image<Rgb8> warped(ImageView<const Rgb8> photograph, const RectifyingMap& map, cv::Size size) {
  return warp(photograph, map, size);
}

Image<Rgb16> warped(ImageView<const Rgb16> photograph, const RectifyingMap& map, cv::Size size) {
  return warp(photograph, map, size);
}

cv::Rect covered_window(const RectifyingMap& left, const RectifyingMap& right, cv::Size size) {
  // Looked at in cells, which count where their corners are covered: a photograph's outline is nearly straight.
  const int cell = std::max(1, std::max(size.width, size.height) / 1000);
  const cv::Matx33d left_back = cv::Matx33d(left.homography.data()).inv();
  const cv::Matx33d right_back = cv::Matx33d(right.homography.data()).inv();
  cv::Mat corners(size.height / cell + 1, size.width / cell + 1, CV_8UC1);
  for (int y = 0; y < corners.rows; ++y)
    for (int x = 0; x < corners.cols; ++x) {
      const PicturePoint place{static_cast<double>(x * cell), static_cast<double>(y * cell)};
      corners.at<std::uint8_t>(y, x) = covers(left, left_back, place) && covers(right, right_back, place) ? 255 : 0;
    }
  if (corners.rows < 2 || corners.cols < 2) return {};
  const auto part = [&](int x, int y) { return corners(cv::Rect(x, y, corners.cols - 1, corners.rows - 1)); };
  const cv::Mat cells = part(0, 0) & part(1, 0) & part(0, 1) & part(1, 1);
  const cv::Rect found = largest_rectangle_within(cells);
  return {found.x * cell, found.y * cell, found.width * cell, found.height * cell};
}

}  // namespace wheatstone
