#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_internal.h"

namespace wheatstone {
namespace {

// Birchfield & Tomasi 1998, sec. 5: the price of an occlusion and the reward of a match, in grey levels.
constexpr int occlusion_penalty = 25;
constexpr int match_reward = 5;
constexpr int infinite = 1 << 28;

/// The smallest and largest value that the interpolated scan line takes within half a pixel of a pixel.
struct Interval {
  int low, high;
};

Interval interval_at(const std::uint8_t* row, int x, int width) {
  const int here = row[x];
  const int before = (here + row[std::max(x - 1, 0)]) / 2, after = (here + row[std::min(x + 1, width - 1)]) / 2;
  return {std::min({before, here, after}), std::max({before, here, after})};
}

/// The dissimilarity that does not mind how the pictures were sampled (Birchfield & Tomasi 1998, sec. 3).
int dissimilarity(const std::uint8_t* own, int x, const std::uint8_t* other, int x_other, int width) {
  const Interval own_interval = interval_at(own, x, width), other_interval = interval_at(other, x_other, width);
  const int own_outside = std::max({0, own[x] - other_interval.high, other_interval.low - own[x]});
  const int other_outside = std::max({0, other[x_other] - own_interval.high, own_interval.low - other[x_other]});
  return std::min(own_outside, other_outside);
}

/// How the best sequence that ends with a match came to it.
enum class PathStep : std::uint8_t { begins, goes_on, skips_other, skips_own };

/// The table of one scan line: for each pixel and disparity the cost of the best sequence of matches that ends there.
class ScanLine {
 public:
  ScanLine(int width, const DisparityRange& range)
      : width_(width),
        least_(range.least),
        count_(range.largest - range.least + 1),
        cost_(static_cast<std::size_t>(width) * count_),
        diagonal_(cost_.size()),
        step_(cost_.size()) {}

  void match(const std::uint8_t* own, const std::uint8_t* other, std::span<float> disparity) {
    for (int x = 0; x < width_; ++x) extend(own, other, x);
    trace_back(disparity);
  }

 private:
  std::size_t at(int x, int i) const { return static_cast<std::size_t>(x) * count_ + i; }

  /// A sequence goes on with the same disparity, or after pixels of the other line were skipped (the disparity falls),
  /// or after as many pixels of this line as the disparity rises by; either is one occlusion.
  void extend(const std::uint8_t* own, const std::uint8_t* other, int x) {
    int best_larger = infinite;
    for (int i = count_ - 1; i >= 0; --i) {
      // diagonal: the best of the matches (x − 1 − k, d − k), k ≥ 1
      diagonal_[at(x, i)] =
          x >= 2 && i >= 1 ? std::min(cost_[at(x - 2, i - 1)], diagonal_[at(x - 1, i - 1)]) : infinite;
      int cost = x == 0 ? 0 : occlusion_penalty;
      PathStep step = PathStep::begins;
      const auto consider = [&](int candidate, PathStep candidate_step) {
        if (candidate < cost) {
          cost = candidate;
          step = candidate_step;
        }
      };
      if (x > 0) {
        consider(best_larger + occlusion_penalty, PathStep::skips_other);
        consider(diagonal_[at(x, i)] + occlusion_penalty, PathStep::skips_own);
        consider(cost_[at(x - 1, i)], PathStep::goes_on);
        best_larger = std::min(best_larger, cost_[at(x - 1, i)]);
      }
      const int x_other = x - (least_ + i);
      const bool inside = x_other >= 0 && x_other < width_;
      cost_[at(x, i)] = inside ? cost + dissimilarity(own, x, other, x_other, width_) - match_reward : infinite;
      step_[at(x, i)] = step;
    }
  }

  void trace_back(std::span<float> disparity) const {
    std::ranges::fill(disparity, std::numeric_limits<float>::quiet_NaN());
    int x = width_ - 1, i = 0;
    for (int end = width_ - 1; end >= 0; --end)
      for (int candidate = 0; candidate < count_; ++candidate)
        if (cost_[at(end, candidate)] < cost_[at(x, i)]) {
          x = end;
          i = candidate;
        }
    while (cost_[at(x, i)] < infinite) {
      disparity[x] = static_cast<float>(least_ + i);
      const PathStep step = step_[at(x, i)];
      if (step == PathStep::begins || x == 0) return;
      if (step == PathStep::skips_other) i = cheapest_above(x - 1, i);
      if (step == PathStep::skips_own) {
        // Follow the diagonal down to the match that its cost came from.
        const int wanted = diagonal_[at(x, i)];
        int k = 1;
        while (cost_[at(x - 1 - k, i - k)] != wanted) ++k;
        x -= k;
        i -= k;
      }
      --x;
    }
  }

  int cheapest_above(int x, int i) const {
    int best = i + 1;
    for (int candidate = i + 1; candidate < count_; ++candidate)
      if (cost_[at(x, candidate)] < cost_[at(x, best)]) best = candidate;
    return best;
  }

  int width_, least_, count_;
  std::vector<int> cost_, diagonal_;
  std::vector<PathStep> step_;
};

}  // namespace

Image<float> match_scan_lines(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range) {
  Image<float> disparity(own.cols, own.rows);
  tbb::parallel_for(0, own.rows, [&](int y) {
    ScanLine(own.cols, range).match(own.ptr<std::uint8_t>(y), other.ptr<std::uint8_t>(y), disparity.row(y));
  });
  return disparity;
}

}  // namespace wheatstone
