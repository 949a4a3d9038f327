#include "wheatstone/calibration/colour_transfer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wheatstone/percentile.h"
namespace wheatstone {
namespace {

using Colour = std::array<double, 3>;

constexpr std::size_t least_samples = 24;

/// Mean of a 5×5 surrounding, 0..1; none where it leaves the picture.
std::optional<Colour> colour_around(ImageView<const Rgb8> picture, const PicturePoint& place) {
  constexpr int reach = 2;
  if (!(std::abs(place.x) < 1e9 && std::abs(place.y) < 1e9)) return {};
  const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
  if (!picture.contains(x - reach, y - reach) || !picture.contains(x + reach, y + reach)) return {};
  Colour sum{};
  for (int j = y - reach; j <= y + reach; ++j) {
    for (int i = x - reach; i <= x + reach; ++i) {
      const Rgb8 pixel = picture(i, j);
      sum[0] += pixel.r;
      sum[1] += pixel.g;
      sum[2] += pixel.b;
    }
  }
  constexpr double pixels = (2 * reach + 1) * (2 * reach + 1);
  for (double& channel : sum) channel /= pixels * 255;
  return sum;
}

struct Sample {
  double right = 0, left = 0;  ///< logarithms of 0..1
};

/// A line through the logarithms, by weights that fall with the distance from it. A gamma of 1 is expected: where all
/// samples are about as bright, only the gain is decided.
void fit_channel(const std::vector<Sample>& samples, double& gain, double& gamma) {
  constexpr int rounds = 20;
  constexpr double likely_off = 0.08, faith_in_gamma = 0.5;
  std::vector<double> ratios;
  for (const Sample& sample : samples) ratios.push_back(sample.left - sample.right);
  double height = percentile(std::move(ratios), 0.5), slope = 1;
  for (int round = 0; round < rounds; ++round) {
    double weights = 0, right = 0, left = 0;
    std::vector<double> weight;
    for (const Sample& sample : samples) {
      const double off = (sample.left - height - slope * sample.right) / likely_off;
      weight.push_back(1 / (1 + off * off));
      weights += weight.back();
      right += weight.back() * sample.right;
      left += weight.back() * sample.left;
    }
    right /= weights;
    left /= weights;
    double spread = faith_in_gamma, common = faith_in_gamma;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      spread += weight[i] * (samples[i].right - right) * (samples[i].right - right);
      common += weight[i] * (samples[i].right - right) * (samples[i].left - left);
    }
    slope = std::clamp(common / spread, 0.5, 2.0);
    height = left - slope * right;
  }
  gain = std::clamp(std::exp(height), 0.2, 5.0);
  gamma = slope;
}

}  // namespace

std::optional<ColourTransfer> find_colour_transfer(ImageView<const Rgb8> left, ImageView<const Rgb8> right,
                                                   std::span<const FeatureMatch> matches) {
  std::array<std::vector<Sample>, 3> samples;
  for (const FeatureMatch& match : matches) {
    const auto in_left = colour_around(left, match.left), in_right = colour_around(right, match.right);
    if (!in_left || !in_right) continue;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      // Black and blown-out pixels tell nothing of exposure.
      constexpr double darkest = 0.03, brightest = 0.97;
      const double l = (*in_left)[channel], r = (*in_right)[channel];
      if (std::min(l, r) > darkest && std::max(l, r) < brightest)
        samples[channel].push_back({std::log(r), std::log(l)});
    }
  }
  ColourTransfer transfer;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    if (samples[channel].size() < least_samples) return {};
    fit_channel(samples[channel], transfer.gain[channel], transfer.gamma[channel]);
  }
  return transfer;
}

void apply_colour_transfer(const ColourTransfer& transfer, ImageView<Rgb8> picture) {
  std::array<std::array<std::uint8_t, 256>, 3> table{};
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (std::size_t code = 0; code < 256; ++code) {
      const double value = transfer.gain[channel] * std::pow(static_cast<double>(code) / 255, transfer.gamma[channel]);
      table[channel][code] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    }
  for (int y = 0; y < picture.height(); ++y)
    for (Rgb8& pixel : picture.row(y)) pixel = {table[0][pixel.r], table[1][pixel.g], table[2][pixel.b]};
}

}  // namespace wheatstone
