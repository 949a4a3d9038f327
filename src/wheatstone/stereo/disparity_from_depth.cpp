#include "wheatstone/stereo/disparity_from_depth.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/error.h"
#include "wheatstone/image/known_values.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

void check_shape(ImageView<const float> depth, ImageView<const Rgb8> picture) {
  if (depth.empty() || picture.empty()) throw Error(ErrorKind::bad_input, "the picture or its depth is empty");
  constexpr double tolerance = 0.01;
  const double scale_x = static_cast<double>(depth.width()) / picture.width();
  const double scale_y = static_cast<double>(depth.height()) / picture.height();
  // A side of a small map is rounded to whole pixels.
  const double rounding = 1.0 / std::min(depth.width(), depth.height());
  if (std::abs(scale_x / scale_y - 1) > std::max(tolerance, rounding))
    throw Error(ErrorKind::bad_input, fmt::format("the depth is {}x{} pixels, expected the shape of the picture, {}x{}",
                                                  depth.width(), depth.height(), picture.width(), picture.height()));
}

/// Larger is nearer, whatever the scale.
Image<float> inverse_depth(ImageView<const float> depth, DepthKind kind) {
  Image<float> inverse(depth.width(), depth.height());
  for (int y = 0; y < depth.height(); ++y)
    std::ranges::transform(depth.row(y), inverse.row(y).begin(), [kind](float value) {
      if (kind == DepthKind::metric) value = value > 0 ? 1 / value : unknown;
      return std::isfinite(value) ? value : unknown;
    });
  return inverse;
}

std::optional<InverseDepthRange> range_of(const Image<float>& inverse) {
  constexpr double outliers = 0.005;
  float far = disparity_percentile(inverse, outliers), near = disparity_percentile(inverse, 1 - outliers);
  if (!(near > far)) {
    far = disparity_percentile(inverse, 0);
    near = disparity_percentile(inverse, 1);
  }
  if (!(near - far > 1e-6f * std::max(std::abs(near), std::abs(far)))) return {};
  return InverseDepthRange{far, near};
}

/// Brings the farthest point to 0 and the nearest to `nearest_px`.
void scale_to(float nearest_px, const InverseDepthRange& range, Image<float>& inverse) {
  const auto [far, near] = range;
  for (float& value : inverse.pixels()) value = nearest_px * std::clamp((value - far) / (near - far), 0.f, 1.f);
}

float distance(Rgb8 a, Rgb8 b) {
  const auto squared = [](int difference) { return static_cast<float>(difference * difference); };
  return std::sqrt(squared(a.r - b.r) + squared(a.g - b.g) + squared(a.b - b.b));
}

/// Where the centre of pixel `i` of a side lies on another side of the same extent, in pixel centres from 0.
struct Place {
  int before, after;
  float share;  ///< of `after`
};
Place place_of(int i, int side, int other_side) {
  const float at = (static_cast<float>(i) + 0.5f) * static_cast<float>(other_side) / static_cast<float>(side) - 0.5f;
  const float inside = std::clamp(at, 0.f, static_cast<float>(other_side - 1));
  const int before = static_cast<int>(inside);
  return {before, std::min(before + 1, other_side - 1), inside - static_cast<float>(before)};
}

/// The picture's colours at the centres of a depth map's pixels.
Image<Rgb8> colours_at(const Image<float>& depth, ImageView<const Rgb8> picture) {
  Image<Rgb8> colours(depth.width(), depth.height());
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x)
      colours(x, y) = picture(place_of(x, depth.width(), picture.width()).before,
                              place_of(y, depth.height(), picture.height()).before);
  return colours;
}

/// The far and the near end of the disparities in a window on a scan line, and whose colours are closer to that of the
/// pixel in its middle.
struct Ends {
  float far, near;
};
bool looks_near(std::span<const float> disparity, std::span<const Rgb8> colours, std::size_t middle, Ends ends) {
  constexpr float own_side = 0.1f, indifferent = 8;
  float to_far = 255, to_near = 255;
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    const float share = (disparity[i] - ends.far) / (ends.near - ends.far);
    const float away = distance(colours[i], colours[middle]);
    if (share < own_side) to_far = std::min(to_far, away);
    if (share > 1 - own_side) to_near = std::min(to_near, away);
  }
  const float share = (disparity[middle] - ends.far) / (ends.near - ends.far);
  return std::abs(to_far - to_near) < indifferent ? share >= 0.5f : to_near < to_far;
}

/// Makes steps of ramps across depth edges. Such ramps come from networks that work on small pictures and from smooth
/// resampling, and would be stretched into a surface that is not there. A pixel between the near and the far end of a
/// window on the scan line is set to the end that has its colour, if the window as a whole and the slopes on both sides
/// of the pixel are steeper than surfaces are.
void sharpen_edges(Image<float>& disparity, ImageView<const Rgb8> picture) {
  constexpr float reach_in_widths = 0.006f, steepest_surface = 0.5f, steepest_pixel = 0.25f;
  const int width = disparity.width();
  const float to_picture = static_cast<float>(picture.width()) / static_cast<float>(width);
  const int reach = std::max(2, static_cast<int>(std::lround(reach_in_widths * static_cast<float>(width))));
  const float steep_px = steepest_surface * to_picture * static_cast<float>(2 * reach + 1);
  const Image<Rgb8> colours = colours_at(disparity, picture);
  const Image<float> before = disparity;
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto from = before.row(y);
    for (int x = 1; x + 1 < width; ++x) {
      const float step_before = from[x] - from[x - 1], step_after = from[x + 1] - from[x];
      if (step_before * step_after <= 0 ||
          std::min(std::abs(step_before), std::abs(step_after)) < steepest_pixel * to_picture)
        continue;
      const int begin = std::max(x - reach, 0), count = std::min(x + reach, width - 1) - begin + 1;
      const auto window = from.subspan(begin, count);
      const auto [far, near] = std::ranges::minmax(window);
      if (near - far < steep_px) continue;
      const bool is_near = looks_near(window, colours.row(y).subspan(begin, count), x - begin, {far, near});
      disparity(x, y) = is_near ? near : far;
    }
  });
}

Image<float> resampled(const Image<float>& small, ImageView<const Rgb8> picture) {
  const int width = picture.width(), height = picture.height();
  const float edge_px = std::max(1.f, static_cast<float>(width) / static_cast<float>(small.width()));
  const Image<Rgb8> colours = colours_at(small, picture);
  Image<float> large(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    const Place row = place_of(y, height, small.height());
    for (int x = 0; x < width; ++x) {
      const Place column = place_of(x, width, small.width());
      const std::array<std::pair<int, int>, 4> corners{{{column.before, row.before},
                                                        {column.after, row.before},
                                                        {column.before, row.after},
                                                        {column.after, row.after}}};
      const std::array<float, 4> weights{(1 - column.share) * (1 - row.share), column.share * (1 - row.share),
                                         (1 - column.share) * row.share, column.share * row.share};
      float least = std::numeric_limits<float>::max(), most = -least, mean = 0, best_likeness = -1, likest = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto [at_x, at_y] = corners[i];
        const float value = small(at_x, at_y);
        least = std::min(least, value);
        most = std::max(most, value);
        mean += weights[i] * value;
        constexpr float colour_spread = 20;
        const float likeness = weights[i] * std::exp(-distance(colours(at_x, at_y), picture(x, y)) / colour_spread);
        if (likeness > best_likeness) {
          best_likeness = likeness;
          likest = value;
        }
      }
      large(x, y) = most - least > edge_px ? likest : mean;
    }
  });
  return large;
}

}  // namespace

std::optional<InverseDepthRange> inverse_depth_range(ImageView<const float> depth, DepthKind kind) {
  const Image<float> inverse = inverse_depth(depth, kind);
  if (!is_known_anywhere(inverse)) return {};
  return range_of(inverse);
}

Image<float> disparity_from_depth(ImageView<const float> depth, ImageView<const Rgb8> picture,
                                  const DisparityFromDepthOptions& options) {
  if (!(options.strength > 0 && options.strength < 1))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the strength is {}, expected a share of the width between 0 and 1", options.strength));
  check_shape(depth, picture);
  Image<float> disparity = inverse_depth(depth, options.kind);
  check_known_anywhere(disparity, "the depth");
  const std::optional<InverseDepthRange> range = options.range ? options.range : range_of(disparity);
  if (!range) return {picture.width(), picture.height()};
  scale_to(options.strength * static_cast<float>(picture.width()), *range, disparity);
  fill_from_farther_side(disparity);
  sharpen_edges(disparity, picture);
  return same_size(disparity, picture) ? std::move(disparity) : resampled(disparity, picture);
}

}  // namespace wheatstone
