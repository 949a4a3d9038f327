#include "wheatstone/matching/depth_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "wheatstone/image/colour.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/random.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {
namespace {

/// The luma of every pixel, 0..255.
Image<float> luma_of(ImageView<const Rgb8> picture) {
  Image<float> luma(picture.width(), picture.height());
  tbb::parallel_for(0, picture.height(), [&](int y) {
    std::ranges::transform(picture.row(y), luma.row(y).begin(), [](Rgb8 colour) { return luma_of(colour); });
  });
  return luma;
}

/// A disparity that was matched, and the inverse of the depth there.
struct DepthSample {
  double inverse_depth, disparity;
};

/// Sums of a line's least squares.
struct LineSums {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0;

  void add(const DepthSample& sample) {
    const auto& [inverse, disparity] = sample;
    weight += 1, x += inverse, y += disparity, xx += inverse * inverse, xy += inverse * disparity;
  }
  std::optional<DepthFit> line() const {
    const double determinant = weight * xx - x * x;
    if (!(determinant > 1e-9 * weight * xx)) return {};
    const double scale = (weight * xy - x * y) / determinant;
    return DepthFit{scale, (y - scale * x) / weight};
  }
};

double distance(const DepthFit& fit, const DepthSample& sample) {
  return std::abs(fit.scale * sample.inverse_depth + fit.offset_px - sample.disparity);
}

/// The line on which most samples lie to within `tolerance_px`: of many lines through two of them (RANSAC, Fischler &
/// Bolles 1981), the best, and then the one that fits those on it. None where most samples lie on no line.
std::optional<DepthFit> consensus(const std::vector<DepthSample>& samples, double tolerance_px) {
  constexpr std::size_t tries = 400, judged = 4000;
  if (samples.size() < 2) return {};
  const std::size_t step = std::max<std::size_t>(samples.size() / judged, 1);
  std::optional<DepthFit> best;
  std::size_t most = samples.size() / step / 2;
  for (std::size_t i = 0; i < tries; ++i) {
    const auto any = [&](std::uint64_t which) { return samples[hash_keys({i, which}) % samples.size()]; };
    LineSums two;
    two.add(any(0));
    two.add(any(1));
    const std::optional<DepthFit> line = two.line();
    // Nearer things have larger disparities.
    if (!line || line->scale <= 0) continue;
    std::size_t on_it = 0;
    for (std::size_t k = 0; k < samples.size(); k += step) on_it += distance(*line, samples[k]) < tolerance_px ? 1 : 0;
    if (on_it <= most) continue;
    most = on_it;
    best = line;
  }
  for (int i = 0; i < 3 && best; ++i) {
    LineSums sums;
    for (const DepthSample& sample : samples)
      if (distance(*best, sample) < tolerance_px) sums.add(sample);
    if (const std::optional<DepthFit> better = sums.line()) best = better;
  }
  return best;
}

/// Goes on from a fit that is right to about a pixel, by comparing colours.
DepthFit refined(const StereoPair& eyes, ImageView<const float> left_depth, const DepthFit& start) {
  constexpr int steps = 8, every = 2;
  constexpr float tolerance = 12;  // levels: beyond, the pixel counts as hidden, or as shining
  const int width = eyes.left.width(), height = eyes.left.height();
  const Image<float> left = luma_of(eyes.left), other = luma_of(eyes.right);
  DepthFit fit = start;
  for (int i = 0; i < steps; ++i) {
    // Gauss-Newton for the sum of (right(x - disparity) - left(x))^2; the unknowns are the changes of scale and offset.
    std::vector<std::array<double, 5>> rows(static_cast<std::size_t>((height + every - 1) / every));
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
      const int y = every * static_cast<int>(row);
      auto& [ss, so, oo, sd, od] = rows[row];
      for (int x = 0; x < width; x += every) {
        const float depth = left_depth(x, y);
        if (!(depth > 0)) continue;
        const double inverse = 1. / depth;
        const double at = x - (fit.scale * inverse + fit.offset_px);
        if (!(at >= 1 && at < width - 2)) continue;
        const int column = static_cast<int>(at);
        const auto share = static_cast<float>(at - column);
        const auto right = [&](int c) { return other(c, y); };
        const float here = right(column) + share * (right(column + 1) - right(column));
        const float slope =
            ((1 - share) * (right(column + 1) - right(column - 1)) + share * (right(column + 2) - right(column))) / 2;
        const float difference = left(x, y) - here;
        if (std::abs(difference) > tolerance) continue;
        // A larger disparity moves the place in the right view to the left.
        const double by_scale = -slope * inverse, by_offset = -slope;
        ss += by_scale * by_scale, so += by_scale * by_offset, oo += by_offset * by_offset;
        sd += by_scale * difference, od += by_offset * difference;
      }
    });
    std::array<double, 5> sums{};
    for (const auto& row : rows)
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += row[k];
    const auto [ss, so, oo, sd, od] = sums;
    const double determinant = ss * oo - so * so;
    if (!(determinant > 1e-9 * ss * oo)) return fit;
    fit.scale += (oo * sd - so * od) / determinant;
    fit.offset_px += (ss * od - so * sd) / determinant;
  }
  return fit;
}

/// The fit that most matched disparities follow, to about half a pixel.
std::optional<DepthFit> matched_fit(const StereoPair& eyes, ImageView<const float> left_depth) {
  constexpr std::uint8_t confirmed = 255;
  constexpr double tolerance_px = 0.75;
  // In black frames, everything would match.
  const std::optional<DisparityRange> range = find_disparity_range(eyes);
  if (!range) return {};
  const std::optional<MatchedPair> matched = match_if_any(eyes, {.range = range});
  if (!matched) return {};
  std::vector<DepthSample> samples;
  for (int y = 0; y < left_depth.height(); ++y)
    for (int x = 0; x < left_depth.width(); ++x)
      if (matched->left_confidence(x, y) == confirmed && left_depth(x, y) > 0)
        samples.push_back({1. / left_depth(x, y), matched->geometry.left_disparity(x, y)});
  return consensus(samples, tolerance_px);
}

/// The depth of every pixel of a smaller picture: that of one pixel there.
Image<float> depth_of_smaller(ImageView<const float> depth, PictureSize size) {
  Image<float> smaller(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      smaller(x, y) =
          depth((2 * x + 1) * depth.width() / (2 * size.width), (2 * y + 1) * depth.height() / (2 * size.height));
  return smaller;
}

}  // namespace

std::optional<DepthFit> fit_depth(const StereoPair& eyes, ImageView<const float> left_depth) {
  constexpr int widest_px = 640;
  const int width = eyes.left.width();
  if (width <= widest_px) {
    const std::optional<DepthFit> fit = matched_fit(eyes, left_depth);
    return fit ? std::optional(refined(eyes, left_depth, *fit)) : std::nullopt;
  }
  const PictureSize size{widest_px, std::max(eyes.left.height() * widest_px / width, 1)};
  std::optional<DepthFit> fit =
      fit_depth({reduced(eyes.left, size), reduced(eyes.right, size)}, depth_of_smaller(left_depth, size));
  if (!fit) return {};
  const double larger = static_cast<double>(width) / widest_px;
  return refined(eyes, left_depth, {larger * fit->scale, larger * fit->offset_px});
}

Image<float> disparity_of_depth(ImageView<const float> depth, const DepthFit& fit) {
  Image<float> disparity(depth.width(), depth.height());
  tbb::parallel_for(0, depth.height(), [&](int y) {
    std::ranges::transform(depth.row(y), disparity.row(y).begin(), [&](float far) {
      return far > 0 ? static_cast<float>(fit.scale / far + fit.offset_px) : std::numeric_limits<float>::quiet_NaN();
    });
  });
  return disparity;
}

double agreeing_share(ImageView<const float> left_disparity, ImageView<const float> right_disparity) {
  std::int64_t agreeing = 0, all = 0;
  for (int y = 0; y < left_disparity.height(); ++y)
    for (int x = 0; x < left_disparity.width(); ++x) {
      const float here = left_disparity(x, y);
      const float there = std::round(static_cast<float>(x) - here);
      if (!(there >= 0 && there < static_cast<float>(right_disparity.width()))) continue;
      ++all;
      agreeing += std::abs(right_disparity(static_cast<int>(there), y) - here) <= 1 ? 1 : 0;
    }
  return static_cast<double>(agreeing) / static_cast<double>(std::max<std::int64_t>(all, 1));
}

}  // namespace wheatstone
