#include "wheatstone/matching/map_flaws_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

// Of a tall strip only so many rows: it would be enlarged to many times its size.
constexpr int most_rows_a_column = 4;

/// A copy of so many columns, in the map's shape, that takes values without mixing them.
Image<float> reduced_to(int columns, ImageView<const float> disparity) {
  const double own_shape = static_cast<double>(disparity.height()) * columns / disparity.width();
  const int most_rows = most_rows_a_column * columns;
  const int rows = std::clamp(static_cast<int>(std::lround(std::min<double>(own_shape, most_rows))), 1, most_rows);
  Image<float> reduced(columns, rows);
  const cv::Mat map = as_mat(reduced);
  cv::resize(as_mat(disparity), map, map.size(), 0, 0, cv::INTER_NEAREST);
  return reduced;
}

constexpr int taps = 15;

/// How many of the values along lines through the pixels of a row lie beyond a tolerance, above the pixel's own value
/// and below it. Where most do, so does their median.
struct Beyond {
  std::vector<int> above, below;
  explicit Beyond(int columns) : above(columns, 0), below(columns, 0) {}

  /// Counts one value of each line; `is_beyond` compares a difference with the tolerance.
  template <class IsBeyond>
  void count(const float* values, const float* own, IsBeyond is_beyond) {
    for (std::size_t x = 0; x < above.size(); ++x) {
      above[x] += is_beyond(values[x] - own[x]) ? 1 : 0;
      below[x] += is_beyond(own[x] - values[x]) ? 1 : 0;
    }
  }

  bool has_median(std::size_t x) const { return above[x] > taps / 2 || below[x] > taps / 2; }
};

/// How many pixels of a row differ from the median of the column about them by more than a tolerance, but not from that
/// of their row. `framed` goes on by taps / 2 beyond each side.
int streaks_of_row(const cv::Mat& framed, int y, float tolerance) {
  constexpr int reach = taps / 2;
  const int columns = framed.cols - 2 * reach;
  const float* const own = framed.ptr<float>(y + reach) + reach;
  Beyond of_column(columns), of_row(columns);
  for (int i = -reach; i <= reach; ++i) {
    of_column.count(framed.ptr<float>(y + reach + i) + reach, own, [&](float by) { return by > tolerance; });
    of_row.count(own + i, own, [&](float by) { return by >= tolerance; });
  }
  int streaks = 0;
  for (std::size_t x = 0; x < of_row.above.size(); ++x)
    streaks += of_column.has_median(x) && !of_row.has_median(x) ? 1 : 0;
  return streaks;
}

}  // namespace

double streak_share(ImageView<const float> disparity) {
  constexpr double share_of_range = 0.03;
  const Image<float> reduced = reduced_to(640, disparity);
  const double range = static_cast<double>(disparity_percentile(reduced, 0.98)) - disparity_percentile(reduced, 0.02);
  const auto tolerance = static_cast<float>(share_of_range * range);
  std::vector<int> streaks(reduced.height(), 0);
  cv::Mat framed;
  cv::copyMakeBorder(as_mat(reduced), framed, taps / 2, taps / 2, taps / 2, taps / 2, cv::BORDER_REFLECT);
  tbb::parallel_for(0, reduced.height(), [&](int y) { streaks[y] = streaks_of_row(framed, y, tolerance); });
  int all = 0;
  for (const int count : streaks) all += count;
  return static_cast<double>(all) / static_cast<double>(reduced.pixels().size());
}

double patch_share(ImageView<const float> disparity, ImageView<const Rgb8> picture) {
  constexpr int side_px = 41, near_px = 6;
  constexpr double share_of_range = 0.08, least_edge = 20, clear_edge = 50;
  const Image<float> reduced = reduced_to(800, disparity);
  const double least = disparity_percentile(reduced, 0.02), largest = disparity_percentile(reduced, 0.98);
  if (!(largest > least)) return 0;
  // OpenCV takes the median of so many pixels of 8 bits only; the range fills half of them.
  constexpr double levels = 128, first = 64;
  cv::Mat map, median, grey, edges;
  as_mat(reduced).convertTo(map, CV_8U, levels / (largest - least), first - least * levels / (largest - least));
  cv::medianBlur(map, median, side_px);
  cv::cvtColor(as_mat(picture), grey, cv::COLOR_RGB2GRAY);
  cv::resize(grey, grey, map.size(), 0, 0, grey.cols > map.cols ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::Canny(grey, edges, least_edge, clear_edge);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * near_px + 1, 2 * near_px + 1});
  cv::dilate(edges, edges, disc);
  cv::absdiff(map, median, map);
  return static_cast<double>(cv::countNonZero((map > share_of_range * levels) & (edges == 0))) /
         static_cast<double>(map.total());
}

}  // namespace wheatstone
