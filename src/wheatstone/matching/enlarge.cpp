#include "wheatstone/matching/enlarge_internal.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace wheatstone {
namespace {

constexpr int channels = 3, own_index = 4;

/// The colours of a copy's row, each twice and one more at both ends, channel by channel.
struct DoubledRow {
  explicit DoubledRow(int width) {
    for (auto& values : channel) values.resize(static_cast<std::size_t>(width) + 6);
  }
  void take(const cv::Mat& copy, int row) {
    const auto* from = copy.ptr<std::uint8_t>(row);
    const int size = static_cast<int>(channel[0].size());
    for (int i = 0; i < size; ++i) {
      const int x = std::clamp(i / 2 - 1, 0, copy.cols - 1);
      for (int c = 0; c < channels; ++c) channel[c][i] = from[channels * x + c];
    }
  }
  std::array<std::vector<std::int16_t>, channels> channel;
};

/// Lowers the keys (sixteen times a colour distance, plus an index) to those of one neighbour where it is more alike.
void compare(const std::array<std::vector<std::int16_t>, channels>& own, const DoubledRow& row, int across, int index,
             std::vector<std::int16_t>& keys) {
  constexpr int own_pixel_bonus = 12;  // neighbours must be clearly more alike
  const int bonus = index == own_index ? own_pixel_bonus : 0;
  const std::ptrdiff_t first = 2 + 2 * std::ptrdiff_t{across};
  const auto* red = row.channel[0].data() + first;
  const auto* green = row.channel[1].data() + first;
  const auto* blue = row.channel[2].data() + first;
  const std::size_t width = keys.size();
  for (std::size_t x = 0; x < width; ++x) {
    const auto distance = static_cast<std::int16_t>(std::abs(own[0][x] - red[x]) + std::abs(own[1][x] - green[x]) +
                                                    std::abs(own[2][x] - blue[x]) - bonus);
    keys[x] = std::min(keys[x], static_cast<std::int16_t>(distance * 16 + index));
  }
}

}  // namespace

Image<std::uint8_t> most_alike_neighbours(const cv::Mat& copy, const cv::Mat& picture) {
  const int width = picture.cols;
  Image<std::uint8_t> alike(width, picture.rows);
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.rows, 16), [&](const tbb::blocked_range<int>& rows) {
    std::array<std::vector<std::int16_t>, channels> own;
    for (auto& values : own) values.resize(width);
    std::vector<std::int16_t> keys(width);
    DoubledRow beside(width);
    for (int y = rows.begin(); y < rows.end(); ++y) {
      const auto* from = picture.ptr<std::uint8_t>(y);
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) own[c][x] = from[channels * x + c];
      std::ranges::fill(keys, std::int16_t{0x7FFF});
      for (int down = -1; down <= 1; ++down) {
        beside.take(copy, std::clamp(y / 2 + down, 0, copy.rows - 1));
        for (int across = -1; across <= 1; ++across) compare(own, beside, across, own_index + 3 * down + across, keys);
      }
      std::ranges::transform(keys, alike.row(y).begin(),
                             [](std::int16_t key) { return static_cast<std::uint8_t>(key & 15); });
    }
  });
  return alike;
}

Image<float> enlarged(const Image<float>& of_copy, const Image<std::uint8_t>& alike) {
  Image<float> result(alike.width(), alike.height());
  const float factor = static_cast<float>(alike.width()) / static_cast<float>(of_copy.width());
  tbb::parallel_for(0, alike.height(), [&](int y) {
    std::array<std::span<const float>, 3> rows;
    for (int j = 0; j < 3; ++j) rows[j] = of_copy.row(std::clamp(y / 2 + j - 1, 0, of_copy.height() - 1));
    const auto index = alike.row(y);
    const auto to = result.row(y);
    for (int x = 0; x < alike.width(); ++x)
      to[x] = rows[index[x] / 3][std::clamp(x / 2 + index[x] % 3 - 1, 0, of_copy.width() - 1)] * factor;
  });
  return result;
}

}  // namespace wheatstone
