#include "wheatstone/matching/match_reliability_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/confirm_internal.h"

namespace wheatstone {
namespace {

/// Costs of all disparities are compared in copies reduced to this many of them.
constexpr double most_costs = 60e6;

/// Mean absolute difference of the windows around each pixel, the right one shifted by a disparity.
cv::Mat cost_at(const cv::Mat& left, const cv::Mat& right, int disparity) {
  constexpr int window_px = 9;
  cv::Mat moved(right.size(), right.type()), cost;
  for (int y = 0; y < right.rows; ++y) {
    const auto* from = right.ptr<std::uint8_t>(y);
    auto* to = moved.ptr<std::uint8_t>(y);
    for (int x = 0; x < right.cols; ++x) to[x] = from[std::clamp(x - disparity, 0, right.cols - 1)];
  }
  cv::absdiff(left, moved, cost);
  cv::boxFilter(cost, cost, CV_32F, {window_px, window_px});
  return cost;
}

struct Costs {
  cv::Mat own;    ///< at the disparity that was found, or one beside it
  cv::Mat rival;  ///< the least at any other
};

Costs compare(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity, int least, int largest) {
  constexpr float infinite = std::numeric_limits<float>::max();
  Costs costs{cv::Mat(left.size(), CV_32F, cv::Scalar(infinite)), cv::Mat(left.size(), CV_32F, cv::Scalar(infinite))};
  for (int d = least; d <= largest; ++d) {
    const cv::Mat cost = cost_at(left, right, d);
    tbb::parallel_for(0, left.rows, [&](int y) {
      const auto* here = cost.ptr<float>(y);
      const auto* found = disparity.ptr<float>(y);
      auto* own = costs.own.ptr<float>(y);
      auto* rival = costs.rival.ptr<float>(y);
      for (int x = 0; x < left.cols; ++x) {
        // What would lie outside the other picture is no rival.
        if (x - d < 0 || x - d >= left.cols) continue;
        const float away = std::abs(static_cast<float>(d) - found[x]);
        constexpr float same_surface_px = 1, other_surface_px = 2.5f;
        if (away <= same_surface_px) own[x] = std::min(own[x], here[x]);
        if (away > other_surface_px) rival[x] = std::min(rival[x], here[x]);
      }
    });
  }
  return costs;
}

struct Step {
  int x, y;
};
/// Opposite directions follow each other.
constexpr std::array<Step, 8> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

constexpr float nothing = std::numeric_limits<float>::infinity();

/// The nearest trusted pixel against one direction.
struct Seen {
  float disparity = nothing;
  int steps_away = 0;
};

bool is_trusted(const Image<float>& disparity, const Image<std::uint8_t>& distinct, int x, int y) {
  return distinct(x, y) != 0 && std::isfinite(disparity(x, y));
}

std::array<Image<Seen>, steps.size()> look_around(const Image<float>& disparity, const Image<std::uint8_t>& distinct) {
  const int width = disparity.width(), height = disparity.height();
  std::array<Image<Seen>, steps.size()> nearest;
  tbb::parallel_for(std::size_t{0}, steps.size(), [&](std::size_t k) {
    const auto [step_x, step_y] = steps[k];
    Image<Seen> seen(width, height);
    for (int j = 0; j < height; ++j) {
      const int y = step_y >= 0 ? j : height - 1 - j;
      for (int i = 0; i < width; ++i) {
        const int x = step_x >= 0 ? i : width - 1 - i;
        if (is_trusted(disparity, distinct, x, y)) {
          seen(x, y) = {disparity(x, y), 0};
        } else if (seen.contains(x - step_x, y - step_y)) {
          seen(x, y) = seen(x - step_x, y - step_y);
          ++seen(x, y).steps_away;
        }
      }
    }
    nearest[k] = std::move(seen);
  });
  return nearest;
}

/// True where a disparity is that of a trusted pixel around, or lies on the straight line between two opposite ones of
/// a surface.
bool continues_surroundings(float disparity, const std::array<Seen, steps.size()>& around) {
  constexpr float tolerance_px = 1, same_surface_px = 3;
  if (!std::isfinite(disparity)) return false;
  for (std::size_t k = 0; k < steps.size(); k += 2) {
    const Seen& a = around[k];
    const Seen& b = around[k + 1];
    if (std::abs(a.disparity - disparity) <= tolerance_px || std::abs(b.disparity - disparity) <= tolerance_px)
      return true;
    if (!(std::abs(a.disparity - b.disparity) <= same_surface_px)) continue;
    const auto to_a = static_cast<float>(a.steps_away), to_b = static_cast<float>(b.steps_away);
    if (std::abs((a.disparity * to_b + b.disparity * to_a) / (to_a + to_b) - disparity) <= tolerance_px) return true;
  }
  return false;
}

}  // namespace

Image<std::uint8_t> find_distinct_matches(const cv::Mat& left, const cv::Mat& right, const Image<float>& disparity,
                                          const DisparityRange& range) {
  const double count = static_cast<double>(range.largest) - range.least + 1;
  // Fewer pixels and fewer disparities: the number of costs falls with the third power.
  const double scale = std::min(1.0, std::cbrt(most_costs / (static_cast<double>(left.total()) * count)));
  cv::Mat small_left, small_right, small_disparity;
  cv::cvtColor(left, small_left, cv::COLOR_RGB2GRAY);
  cv::cvtColor(right, small_right, cv::COLOR_RGB2GRAY);
  small_disparity = as_mat(disparity);
  if (scale < 1) {
    small_left = shrunk(small_left, scale);
    small_right = shrunk(small_right, scale);
    cv::resize(small_disparity, small_disparity, small_left.size(), 0, 0, cv::INTER_NEAREST);
    small_disparity *= scale;
  }
  const Costs costs =
      compare(small_left, small_right, small_disparity, static_cast<int>(std::floor(range.least * scale)),
              static_cast<int>(std::ceil(range.largest * scale)));

  constexpr double noise = 0.3;  // grey levels, of a window's mean
  const cv::Mat clear = costs.rival > costs.own + noise;
  Image<std::uint8_t> distinct(disparity.width(), disparity.height());
  cv::Mat target = as_mat(distinct);
  cv::resize(clear, target, target.size(), 0, 0, cv::INTER_NEAREST);
  return distinct;
}

void replace_doubtful(Image<float>& disparity, const Image<float>& other, const Image<std::uint8_t>& distinct,
                      const DisparityRange& range) {
  const int width = disparity.width(), height = disparity.height();
  const std::array<Image<Seen>, steps.size()> nearest = look_around(disparity, distinct);
  const Image<float> before = disparity;
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (is_trusted(before, distinct, x, y)) continue;
      std::array<Seen, steps.size()> around{};
      std::ranges::transform(nearest, around.begin(), [&](const Image<Seen>& seen) { return seen(x, y); });
      if (continues_surroundings(before(x, y), around)) continue;
      std::ranges::sort(around, {}, &Seen::disparity);
      const auto known = std::ranges::count_if(around, [](const Seen& seen) { return seen.disparity < nothing; });
      if (known == 0 || is_hidden_from(other.row(y), x, range)) continue;
      disparity(x, y) = around[static_cast<std::size_t>(known - 1) / 2].disparity;
    }
  });
}

}  // namespace wheatstone
