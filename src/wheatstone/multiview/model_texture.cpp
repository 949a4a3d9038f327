#include "wheatstone/multiview/model_texture_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

Image<Rgb8> half_of(const Image<Rgb8>& picture) {
  const std::array<float, 256>& linear = linear_codes();
  Image<Rgb8> half((picture.width() + 1) / 2, (picture.height() + 1) / 2);
  tbb::parallel_for(0, half.height(), [&](int y) {
    for (int x = 0; x < half.width(); ++x) {
      std::array<float, 3> sum{};
      for (const int dy : {0, 1}) {
        for (const int dx : {0, 1}) {
          const Rgb8 pixel =
              picture(std::min(2 * x + dx, picture.width() - 1), std::min(2 * y + dy, picture.height() - 1));
          sum[0] += linear[pixel.r];
          sum[1] += linear[pixel.g];
          sum[2] += linear[pixel.b];
        }
      }
      half(x, y) = {srgb_from_linear(sum[0] / 4), srgb_from_linear(sum[1] / 4), srgb_from_linear(sum[2] / 4)};
    }
  });
  return half;
}

}  // namespace

const std::array<float, 256>& linear_codes() {
  static const std::array<float, 256> codes = [] {
    std::array<float, 256> all{};
    for (std::size_t code = 0; code < all.size(); ++code) all[code] = linear_from_srgb(static_cast<std::uint8_t>(code));
    return all;
  }();
  return codes;
}

ModelTexture::ModelTexture(const Image<Rgb8>& picture) {
  levels_.push_back(picture);
  while (levels_.back().width() > 1 || levels_.back().height() > 1) levels_.push_back(half_of(levels_.back()));
}

std::array<float, 3> ModelTexture::in_level(std::size_t level, float u, float v) const {
  const std::array<float, 256>& linear = linear_codes();
  const Image<Rgb8>& picture = levels_[level];
  const int width = picture.width(), height = picture.height();
  const float x = (u - std::floor(u)) * static_cast<float>(width) - 0.5f;
  const float y = (1 - (v - std::floor(v))) * static_cast<float>(height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const float across = x - left, down = y - top;
  // The texture repeats; places lie at most half of a pixel beside it.
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const int x0 = column < 0 ? width - 1 : column, x1 = column + 1 < width ? column + 1 : 0;
  const int y0 = row < 0 ? height - 1 : row, y1 = row + 1 < height ? row + 1 : 0;
  std::array<float, 3> sum{};
  const auto add = [&](Rgb8 pixel, float weight) {
    sum[0] += weight * linear[pixel.r];
    sum[1] += weight * linear[pixel.g];
    sum[2] += weight * linear[pixel.b];
  };
  add(picture(x0, y0), (1 - across) * (1 - down));
  add(picture(x1, y0), across * (1 - down));
  add(picture(x0, y1), (1 - across) * down);
  add(picture(x1, y1), across * down);
  return sum;
}

float ModelTexture::level(float pixels_across) const {
  return pixels_across > 1 ? std::min(std::log2(pixels_across), static_cast<float>(levels_.size() - 1)) : 0;
}

std::array<float, 3> ModelTexture::at(float u, float v, float level) const {
  const auto finer = static_cast<std::size_t>(level);
  const float share = level - static_cast<float>(finer);
  std::array<float, 3> colour = in_level(finer, u, v);
  if (share > 0) {
    const std::array<float, 3> coarser = in_level(finer + 1, u, v);
    for (std::size_t c = 0; c < 3; ++c) colour[c] += share * (coarser[c] - colour[c]);
  }
  return colour;
}

}  // namespace wheatstone
