// Semi-global matching against the same sums made one by one.

#include "wheatstone/matching/semi_global_internal.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/random.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::semi_global_test {

constexpr int past_band = 1 << 20;

/// A step in depth with grain, and noise of its own in each eye.
StereoPair grainy_step(int width, int height) {
  StereoPair pair{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  const auto value = [](int x, int y, std::uint64_t kind) {
    const auto key = [](int at) { return static_cast<std::uint64_t>(at) + 4096; };
    return unit_float(hash_keys({key(x / 2), key(y / 2), kind}));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int eye : {0, 1}) {
        const int shift = y < height / 2 ? 3 : 9;
        const auto channel = [&](std::uint64_t kind) {
          const float noise = 12 * value(2 * x + eye * 500, 2 * y, kind + 7);
          return static_cast<std::uint8_t>(30 + 180 * value(eye == 0 ? x : x + shift, y, kind) + noise);
        };
        (eye == 0 ? pair.left : pair.right)(x, y) = {channel(1), channel(2), channel(3)};
      }
    }
  }
  return pair;
}

/// Costs of matches, one by one.
class PlainCosts {
 public:
  explicit PlainCosts(const StereoPair& pair) : left_(as_mat(pair.left)), right_(as_mat(pair.right)) {
    cv::cvtColor(left_, left_grey, cv::COLOR_RGB2GRAY);
    cv::cvtColor(right_, right_grey_, cv::COLOR_RGB2GRAY);
  }

  int operator()(int x, int y, int disparity) const {
    constexpr int outside_cost = 30, most_colour_cost = 30;
    const int there = x - disparity;
    if (there < 0 || there >= left_.cols) return outside_cost;
    int cost = 0;
    for (int down = -3; down <= 3; ++down)
      for (int across = -4; across <= 4; ++across)
        cost += darker(left_grey, x, y, across, down) != darker(right_grey_, there, y, across, down) ? 1 : 0;
    int colour = 0;
    for (int channel = 0; channel < 3; ++channel) {
      const auto value = [&](int at) { return right_.at<cv::Vec3b>(y, std::clamp(at, 0, right_.cols - 1))[channel]; };
      const double own = value(there), before = (own + value(there - 1)) / 2, after = (own + value(there + 1)) / 2;
      const int least = static_cast<int>(std::floor(std::min({own, before, after})));
      const int most = static_cast<int>(std::ceil(std::max({own, before, after})));
      const int here = left_.at<cv::Vec3b>(y, x)[channel];
      colour += std::max({0, here - most, least - here});
    }
    return cost + std::min(colour / 3, most_colour_cost);
  }

  cv::Mat left_grey;

 private:
  static bool darker(const cv::Mat& grey, int x, int y, int across, int down) {
    const int there_x = cv::borderInterpolate(x + across, grey.cols, cv::BORDER_REFLECT_101);
    const int there_y = cv::borderInterpolate(y + down, grey.rows, cv::BORDER_REFLECT_101);
    return grey.at<std::uint8_t>(there_y, there_x) < grey.at<std::uint8_t>(y, x);
  }

  cv::Mat left_, right_, right_grey_;
};

/// All sums of eight paths, [(y · width + x) · count + k].
std::vector<int> plain_sums(const PlainCosts& costs, const SearchBand& band) {
  const int width = band.first.width(), height = band.first.height(), count = band.count;
  const auto at = [&](int x, int y) { return (static_cast<std::size_t>(y) * width + x) * count; };
  std::vector<int> sums(at(0, height), 0), path(sums.size());
  for (const auto& [across, down] :
       std::array<std::array<int, 2>, 8>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}}) {
    for (int i = 0; i < width * height; ++i) {
      const int pixel = across + down * 2 > 0 || (down == 1) ? i : width * height - 1 - i;
      const int x = pixel % width, y = pixel / width, from_x = x - across, from_y = y - down;
      const bool begins = from_x < 0 || from_x >= width || from_y < 0 || from_y >= height;
      const int* from = begins ? nullptr : &path[at(from_x, from_y)];
      const int least = begins ? 0 : *std::min_element(from, from + count);
      const int shift = begins ? 0 : band.first(x, y) - band.first(from_x, from_y);
      const auto before = [&](int k) { return k + shift >= 0 && k + shift < count ? from[k + shift] : past_band; };
      for (int k = 0; k < count; ++k) {
        int value = costs(x, y, band.first(x, y) + k);
        if (!begins) {
          const int edge =
              std::abs(costs.left_grey.at<std::uint8_t>(y, x) - costs.left_grey.at<std::uint8_t>(from_y, from_x));
          value +=
              std::min({before(k), before(k - 1) + 60, before(k + 1) + 60, least + std::max(63, 4000 / (8 + edge))}) -
              least;
        }
        path[at(x, y) + k] = value;
        sums[at(x, y) + k] += value;
      }
    }
  }
  return sums;
}

/// The least sums of both pictures' pixels; whole disparities.
BandMatch plain_match(const std::vector<int>& sums, const SearchBand& band) {
  const int width = band.first.width(), height = band.first.height();
  BandMatch match{Image<float>(width, height), Image<float>(width, height, std::numeric_limits<float>::quiet_NaN())};
  for (int y = 0; y < height; ++y) {
    std::vector<int> least(width, past_band);
    for (int x = 0; x < width; ++x) {
      const int* sum = &sums[(static_cast<std::size_t>(y) * width + x) * band.count];
      const int first = band.first(x, y);
      match.left(x, y) = static_cast<float>(first + (std::min_element(sum, sum + band.count) - sum));
      for (int k = 0; k < band.count; ++k) {
        const int there = x - first - k;
        if (there < 0 || there >= width || sum[k] >= least[there]) continue;
        least[there] = sum[k];
        match.right(there, y) = static_cast<float>(first + k);
      }
    }
  }
  return match;
}

/// One band for all pixels, and one that follows a slope with steps, some of them out of each other's reach.
std::vector<SearchBand> bands(int width, int height) {
  SearchBand same{Image<std::int16_t>(width, height, -3), 21};
  SearchBand varying{Image<std::int16_t>(width, height), 16};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      varying.first(x, y) = static_cast<std::int16_t>((y < height / 2 ? -4 : 2) + x % 5 / 3 + (x > width - 9 ? 40 : 0));
  return {same, varying};
}

bool same_bytes(const Image<float>& a, const Image<float>& b) {
  return std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

TEST(SemiGlobal, FindsWhatSumsMadeOneByOneHave) {
  for (const auto& [width, height] : {std::pair{53, 30}, {33, 17}}) {
    const StereoPair pair = grainy_step(width, height);
    const PlainCosts costs(pair);
    for (const SearchBand& band : bands(width, height)) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << " count " << band.count);
      const BandMatch found = match_semi_global(as_mat(pair.left), as_mat(pair.right), band);
      const BandMatch plain = plain_match(plain_sums(costs, band), band);
      for (std::size_t i = 0; i < plain.left.pixels().size(); ++i)
        ASSERT_LE(std::abs(found.left.pixels()[i] - plain.left.pixels()[i]), 0.5f) << i % width << " " << i / width;
      EXPECT_TRUE(same_bytes(found.right, plain.right));
    }
  }
}

TEST(SemiGlobal, GivesTheSameBytesWithEveryInstructionSet) {
  // More rows than a strip has.
  constexpr int width = 61, height = 260;
  const StereoPair pair = grainy_step(width, height);
  for (const SearchBand& band : bands(width, height)) {
    const BandMatch best = match_semi_global(as_mat(pair.left), as_mat(pair.right), band);
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      const BandMatch match = match_semi_global(as_mat(pair.left), as_mat(pair.right), band);
      EXPECT_TRUE(same_bytes(match.left, best.left)) << hwy::TargetName(target);
      EXPECT_TRUE(same_bytes(match.right, best.right)) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace wheatstone::semi_global_test
