#include "wheatstone/matching/semi_global_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace wheatstone {
namespace {

using Cost = std::int16_t;

constexpr int census_across = 4, census_down = 3;  ///< half sides
constexpr int most_colour_cost = 30;
constexpr Cost outside_cost = 30;
constexpr int small_step_cost = 60, large_step_cost = 500;  ///< P1 and P2
constexpr Cost unreachable = 12000;

/// Rows of a strip, and rows beside it on either side that lead the paths into it. All sizes of costs of a strip and a
/// thread: 300 rows of 4000 pixels and 16 disparities are 38 MB.
constexpr int strip_rows = 224, lead_rows = 40;

using Census = std::vector<std::uint64_t>;

/// A bit a neighbour: whether it is darker than the pixel.
Census census_of(const cv::Mat& grey) {
  cv::Mat wide;
  cv::copyMakeBorder(grey, wide, census_down, census_down, census_across, census_across, cv::BORDER_REFLECT_101);
  Census census(grey.total());
  tbb::parallel_for(0, grey.rows, [&](int y) {
    const auto* own = grey.ptr<std::uint8_t>(y);
    std::uint64_t* to = &census[static_cast<std::size_t>(y) * grey.cols];
    std::fill_n(to, grey.cols, 0);
    for (int down = 0; down <= 2 * census_down; ++down) {
      for (int across = 0; across <= 2 * census_across; ++across) {
        if (down == census_down && across == census_across) continue;
        const auto* other = wide.ptr<std::uint8_t>(y + down) + across;
        for (int x = 0; x < grey.cols; ++x) to[x] = to[x] << 1 | static_cast<std::uint64_t>(other[x] < own[x]);
      }
    }
  });
  return census;
}

/// What the costs are made of.
struct Compared {
  cv::Mat left, right;              ///< 8-bit RGB
  cv::Mat right_least, right_most;  ///< of each channel, over half a pixel to either side
  cv::Mat grey;                     ///< of the left picture
  Census left_census, right_census;
};

Compared prepare(const cv::Mat& left, const cv::Mat& right) {
  Compared pictures{left, right, {}, {}, {}, {}, {}};
  cv::Mat right_grey;
  cv::cvtColor(left, pictures.grey, cv::COLOR_RGB2GRAY);
  cv::cvtColor(right, right_grey, cv::COLOR_RGB2GRAY);
  pictures.left_census = census_of(pictures.grey);
  pictures.right_census = census_of(right_grey);
  // Values half-way to either neighbour, as Birchfield & Tomasi compare them.
  cv::Mat half_left, half_right;
  const cv::Mat to_left = (cv::Mat_<float>(1, 3) << 0.5f, 0.5f, 0), to_right = (cv::Mat_<float>(1, 3) << 0, 0.5f, 0.5f);
  cv::filter2D(right, half_left, -1, to_left, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::filter2D(right, half_right, -1, to_right, {-1, -1}, 0, cv::BORDER_REPLICATE);
  pictures.right_least = cv::min(cv::min(half_left, half_right), right);
  pictures.right_most = cv::max(cv::max(half_left, half_right), right);
  return pictures;
}

/// Some rows of the picture with a value for each disparity of each pixel's band.
struct Volume {
  int first_row, rows, width, count;
  std::vector<Cost> values;
  Volume(int top, int row_count, int columns, int disparities)
      : first_row(top),
        rows(row_count),
        width(columns),
        count(disparities),
        values(static_cast<std::size_t>(row_count) * columns * disparities) {}
  Cost* at(int x, int y) { return &values[(static_cast<std::size_t>(y - first_row) * width + x) * count]; }
  const Cost* at(int x, int y) const { return &values[(static_cast<std::size_t>(y - first_row) * width + x) * count]; }
};

void compare_row(const Compared& pictures, const SearchBand& band, int y, Volume& costs) {
  const int width = costs.width;
  const auto* own = pictures.left.ptr<cv::Vec3b>(y);
  const auto* least = pictures.right_least.ptr<cv::Vec3b>(y);
  const auto* most = pictures.right_most.ptr<cv::Vec3b>(y);
  const std::uint64_t* own_census = &pictures.left_census[static_cast<std::size_t>(y) * width];
  const std::uint64_t* other_census = &pictures.right_census[static_cast<std::size_t>(y) * width];
  for (int x = 0; x < width; ++x) {
    Cost* to = costs.at(x, y);
    for (int k = 0; k < band.count; ++k) {
      const int there = x - band.first(x, y) - k;
      if (there < 0 || there >= width) {
        to[k] = outside_cost;
        continue;
      }
      int colour = 0;
      for (int channel = 0; channel < 3; ++channel)
        colour += std::max({0, own[x][channel] - most[there][channel], least[there][channel] - own[x][channel]});
      to[k] = static_cast<Cost>(std::popcount(own_census[x] ^ other_census[there]) +
                                std::min(colour / 3, most_colour_cost));
    }
  }
}

/// The costs of paths that end in the pixels of one row, with room for a disparity before and after each band.
struct PathRow {
  PathRow(int width, int count)
      : stride(count + 2), values(static_cast<std::size_t>(width) * stride, unreachable), least(width, 0) {}
  Cost* at(int x) { return &values[static_cast<std::size_t>(x) * stride + 1]; }
  int stride;
  std::vector<Cost> values;
  std::vector<Cost> least;
};

/// One path's step from the pixel before it, `from` with its least value, whose band begins `shift` before this one's;
/// Hirschmüller 2008, eq. 13.
struct PathStep {
  const Cost* from;
  Cost least;
  int shift;
  Cost large_step;
};

Cost extend_path(const PathStep& step, const Cost* cost, int count, std::vector<Cost>& aligned, Cost* to, Cost* sum) {
  const Cost* from = step.from;
  if (step.shift != 0) {
    Cost* moved = aligned.data() + 1;
    for (int k = -1; k <= count; ++k) {
      const int there = k + step.shift;
      moved[k] = there >= 0 && there < count ? step.from[there] : unreachable;
    }
    from = moved;
  }
  const auto jump = static_cast<Cost>(step.least + step.large_step);
  Cost least = std::numeric_limits<Cost>::max();
  for (int k = 0; k < count; ++k) {
    const auto beside = static_cast<Cost>(std::min(from[k - 1], from[k + 1]) + small_step_cost);
    const Cost best = std::min(std::min(from[k], beside), jump);
    const auto value = static_cast<Cost>(best - step.least + cost[k]);
    to[k] = value;
    least = std::min(least, value);
    sum[k] = static_cast<Cost>(sum[k] + value);
  }
  return least;
}

/// Adds the paths from above and from the left, or, `upwards`, from below and from the right.
void add_paths(const Compared& pictures, const SearchBand& band, const Volume& costs, bool upwards, Volume& sums) {
  constexpr std::array<std::array<int, 2>, 4> before{{{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};
  const int width = costs.width, count = costs.count, direction = upwards ? -1 : 1;
  std::vector<PathRow> now(before.size(), {width, count}), last(before.size(), {width, count});
  std::vector<Cost> aligned(static_cast<std::size_t>(count) + 2);
  const std::vector<Cost> beginning(static_cast<std::size_t>(count) + 2, 0);
  for (int j = 0; j < costs.rows; ++j) {
    const int y = costs.first_row + (upwards ? costs.rows - 1 - j : j);
    const auto* grey = pictures.grey.ptr<std::uint8_t>(y);
    for (int i = 0; i < width; ++i) {
      const int x = upwards ? width - 1 - i : i;
      for (std::size_t path = 0; path < before.size(); ++path) {
        const int from_x = x + direction * before[path][0], row = direction * before[path][1];
        PathRow& source = row == 0 ? now[path] : last[path];
        const bool begins = from_x < 0 || from_x >= width || (row != 0 && j == 0);
        PathStep step{beginning.data() + 1, 0, 0, 0};
        if (!begins) {
          const int edge = std::abs(grey[x] - pictures.grey.ptr<std::uint8_t>(y + row)[from_x]);
          step = {source.at(from_x), source.least[from_x], band.first(x, y) - band.first(from_x, y + row),
                  static_cast<Cost>(std::max(small_step_cost + 3, large_step_cost * 8 / (8 + edge)))};
        }
        now[path].least[x] = extend_path(step, costs.at(x, y), count, aligned, now[path].at(x), sums.at(x, y));
      }
    }
    std::swap(now, last);
  }
}

/// The offset of the lowest point of two lines of opposite slope through three sums, the middle one the least.
float between_pixels(const Cost* sums, int k, int count) {
  if (k == 0 || k == count - 1) return 0;
  const int before = sums[k - 1] - sums[k], after = sums[k + 1] - sums[k];
  const int steeper = std::max(before, after);
  return steeper > 0 ? static_cast<float>(before - after) / static_cast<float>(2 * steeper) : 0;
}

void choose_row(const Volume& sums, const SearchBand& band, int y, BandMatch& result) {
  const int width = sums.width, count = sums.count;
  std::vector<Cost> least(width, std::numeric_limits<Cost>::max());
  const auto left = result.left.row(y), right = result.right.row(y);
  for (int x = 0; x < width; ++x) {
    const Cost* sum = sums.at(x, y);
    const int first = band.first(x, y);
    const int best = static_cast<int>(std::min_element(sum, sum + count) - sum);
    left[x] = static_cast<float>(first + best) + between_pixels(sum, best, count);
    for (int k = 0; k < count; ++k) {
      const int there = x - first - k;
      if (there < 0 || there >= width || sum[k] >= least[there]) continue;
      least[there] = sum[k];
      right[there] = static_cast<float>(first + k);
    }
  }
}

}  // namespace

BandMatch match_semi_global(const cv::Mat& left, const cv::Mat& right, const SearchBand& band) {
  const Compared pictures = prepare(left, right);
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  BandMatch result{Image<float>(left.cols, left.rows, unknown), Image<float>(left.cols, left.rows, unknown)};
  const int strips = (left.rows + strip_rows - 1) / strip_rows;
  tbb::parallel_for(0, strips, [&](int strip) {
    const int begin = strip * strip_rows, end = std::min(begin + strip_rows, left.rows);
    const int top = std::max(begin - lead_rows, 0), bottom = std::min(end + lead_rows, left.rows);
    Volume costs(top, bottom - top, left.cols, band.count), sums(top, bottom - top, left.cols, band.count);
    for (int y = top; y < bottom; ++y) compare_row(pictures, band, y, costs);
    for (const bool upwards : {false, true}) add_paths(pictures, band, costs, upwards, sums);
    for (int y = begin; y < end; ++y) choose_row(sums, band, y, result);
  });
  return result;
}

}  // namespace wheatstone
