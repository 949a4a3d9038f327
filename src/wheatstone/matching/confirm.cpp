#include "wheatstone/matching/confirm_internal.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {

Image<float> confirmed_disparity(const Image<float>& own, const Image<float>& other, float sign, float tolerance_px) {
  Image<float> result(own.width(), own.height(), unknown);
  tbb::parallel_for(0, own.height(), [&](int y) {
    const auto from = own.row(y), into = other.row(y);
    const auto to = result.row(y);
    for (int x = 0; x < own.width(); ++x) {
      const float target = std::floor(static_cast<float>(x) + 0.5f + sign * from[x]);
      if (!(target >= 0 && target < static_cast<float>(own.width()))) continue;
      if (std::abs(into[static_cast<int>(target)] - from[x]) <= tolerance_px) to[x] = from[x];
    }
  });
  return result;
}

bool is_hidden_from(std::span<const float> right, int x, const DisparityRange& range) {
  const int begin = std::max(x - range.largest, 0);
  const int end = std::min(x - range.least + 1, static_cast<int>(right.size()));
  for (int there = begin; there < end; ++there)
    if (std::abs(right[there] - static_cast<float>(x - there)) <= 1) return false;
  return true;
}

cv::Mat in_sixteenths(const Image<float>& disparity, float sign) {
  cv::Mat sixteenths(disparity.height(), disparity.width(), CV_16S);
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    for (int x = 0; x < disparity.width(); ++x)
      sixteenths.at<std::int16_t>(y, x) =
          std::isfinite(disparity(x, y))
              ? static_cast<std::int16_t>(std::lround(sign * disparity(x, y) * sixteenths_a_px))
              : static_cast<std::int16_t>(unknown_sixteenths);
  });
  return sixteenths;
}

namespace {

/// Stands for pixels whose disparity is unknown.
constexpr int no_disparity = std::numeric_limits<int>::min();

/// The disparities in sixteenths, so that patches do not depend on the last bits of them.
Image<int> whole_sixteenths(const Image<float>& disparity) {
  Image<int> sixteenths(disparity.width(), disparity.height());
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    std::ranges::transform(disparity.row(y), sixteenths.row(y).begin(), [](float d) {
      return std::isfinite(d) ? static_cast<int>(std::lround(d * sixteenths_a_px)) : no_disparity;
    });
  });
  return sixteenths;
}

/// Patches of pixels that are connected by steps to neighbours of like disparity, as trees. A root holds minus the
/// number of its patch's pixels, every other pixel the index of its parent, which is smaller than its own. Indices
/// count pixels row by row.
class Patches {
 public:
  explicit Patches(const Image<int>& sixteenths)
      : values_(sixteenths.pixels()), width_(sixteenths.width()), trees_(values_.size(), -1) {
    for_each_band(sixteenths.height(), [&](const cv::Range& rows) {
      for (int y = rows.start; y < rows.end; ++y) {
        for (int x = 1; x < width_; ++x) join_if_alike(y * width_ + x - 1, y * width_ + x);
        if (y > rows.start) join_to_row_above(y);
      }
    });
    for (int y = rows_a_band; y < sixteenths.height(); y += rows_a_band) join_to_row_above(y);
    // From the first pixel on, every parent is a root or hangs on one: all become children of their roots.
    for (int& parent : trees_)
      if (parent >= 0 && trees_[parent] >= 0) parent = trees_[parent];
  }

  int size_of_patch(int at) const { return -(trees_[at] >= 0 ? trees_[trees_[at]] : trees_[at]); }

 private:
  bool are_alike(int a, int b) const {
    constexpr int same_surface = 2 * sixteenths_a_px;
    return values_[a] != no_disparity && values_[b] != no_disparity &&
           std::abs(values_[a] - values_[b]) <= same_surface;
  }
  int root_of(int at) {
    while (trees_[at] >= 0) {
      if (trees_[trees_[at]] >= 0) trees_[at] = trees_[trees_[at]];
      at = trees_[at];
    }
    return at;
  }
  void join_if_alike(int a, int b) {
    if (!are_alike(a, b)) return;
    const int root = root_of(a), other = root_of(b);
    if (root == other) return;
    const auto [least, largest] = std::minmax(root, other);
    trees_[least] += trees_[largest];
    trees_[largest] = least;
  }
  void join_to_row_above(int y) {
    for (int x = 0, at = y * width_; x < width_; ++x, ++at) join_if_alike(at - width_, at);
  }

  std::span<const int> values_;
  int width_;
  std::vector<int> trees_;
};

}  // namespace

// OpenCV's filterSpeckles keeps places as 16-bit numbers: it writes beyond its memory where a side is longer.
void remove_speckles(Image<float>& disparity, int least_surface_px) {
  const Image<int> sixteenths = whole_sixteenths(disparity);
  const Patches patches(sixteenths);
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto row = disparity.row(y);
    const auto known = sixteenths.row(y);
    for (int x = 0; x < disparity.width(); ++x)
      if (known[x] != no_disparity && patches.size_of_patch(y * disparity.width() + x) <= least_surface_px)
        row[x] = unknown;
  });
}

cv::Mat unknown_places(const cv::Mat& disparity) { return ~(disparity == disparity); }

void remove_speckles_but_holes(Image<float>& disparity, int least_surface_px) {
  constexpr int least_hole_px = 40, nearby_share = 8;  // of the width
  constexpr float step_px = 1;
  Image<float> holes = disparity;
  tbb::parallel_invoke([&] { remove_speckles(holes, std::min(least_hole_px, least_surface_px)); },
                       [&] { remove_speckles(disparity, least_surface_px); });
  if (known_share(disparity) == 0) return;
  Image<float> beside = disparity, farthest = disparity;
  fill_from_farther_side(beside);
  cv::Mat nearby = as_mat(farthest);
  nearby.setTo(std::numeric_limits<float>::max(), unknown_places(as_mat(disparity)));
  const int nearby_px = disparity.width() / nearby_share | 1;
  cv::erode(nearby, nearby, cv::getStructuringElement(cv::MORPH_RECT, {nearby_px, nearby_px}));
  const auto kept = disparity.pixels(), hole = holes.pixels();
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (std::isnan(kept[i]) && hole[i] < beside.pixels()[i] - step_px && hole[i] >= farthest.pixels()[i] - step_px)
      kept[i] = hole[i];
}

double known_share(const Image<float>& disparity) {
  const auto known = std::ranges::count_if(disparity.pixels(), [](float d) { return std::isfinite(d); });
  return static_cast<double>(known) / static_cast<double>(disparity.pixels().size());
}

}  // namespace wheatstone
