#include "wheatstone/display/arrange.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/image/shared_image.h"

namespace wheatstone {
namespace {

ImageView<const Rgb8> columns_of(ImageView<const Rgb8> picture, int first, int count) {
  return {picture.data() + first, count, picture.height(), picture.stride()};
}

}  // namespace

Image<Rgb8> side_by_side(const StereoPairView& pair) {
  const int width = pair.left.width();
  Image<Rgb8> both(width + pair.right.width(), pair.left.height());
  for (int y = 0; y < both.height(); ++y) {
    std::ranges::copy(pair.left.row(y), both.row(y).begin());
    std::ranges::copy(pair.right.row(y), both.row(y).begin() + width);
  }
  return both;
}

StereoPairView set_convergence(const StereoPairView& pair, float zero_parallax_px) {
  const int width = pair.left.width();
  shared_width(width, zero_parallax_px);
  const auto shift = static_cast<int>(std::lround(zero_parallax_px));
  const int common = width - std::abs(shift);
  return {columns_of(pair.left, std::max(shift, 0), common), columns_of(pair.right, std::max(-shift, 0), common)};
}

std::vector<Image<Rgb8>> shifted_views(std::vector<Image<Rgb8>> views, float disparity_px) {
  if (views.empty()) return views;
  const int width = views.front().width();
  shared_width(width, static_cast<double>(disparity_px) * static_cast<double>(views.size() - 1));
  // A point of this disparity stands at x − i·d in the view i: all take their columns from there.
  std::vector<int> first(views.size());
  for (std::size_t i = 0; i < views.size(); ++i)
    first[i] = -static_cast<int>(std::lround(static_cast<double>(disparity_px) * static_cast<double>(i)));
  const auto [least, most] = std::ranges::minmax(first);
  const int common = width - (most - least);
  for (std::size_t i = 0; i < views.size(); ++i) views[i] = copy_of(columns_of(views[i], first[i] - least, common));
  return views;
}

void put_floating_window(StereoPair& pair, int left_px, int right_px) {
  const int width = pair.left.width();
  const int left = std::clamp(left_px, 0, width), right = std::clamp(right_px, 0, width);
  for (int y = 0; y < pair.left.height(); ++y) {
    std::ranges::fill(pair.left.row(y).first(left), Rgb8{});
    std::ranges::fill(pair.right.row(y).last(right), Rgb8{});
  }
}

Image<Rgb8> depth_beside(ImageView<const Rgb8> picture, ImageView<const float> disparity) {
  constexpr double outliers = 0.005;
  const float farthest = disparity_percentile(disparity, outliers);
  const float nearest = disparity_percentile(disparity, 1 - outliers);
  const float scale = nearest > farthest ? 255 / (nearest - farthest) : 0;
  Image<Rgb8> both(2 * picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y) {
    std::ranges::copy(picture.row(y), both.row(y).begin());
    std::ranges::transform(disparity.row(y), both.row(y).begin() + picture.width(), [&](float d) {
      const float nearness = std::isfinite(d) ? std::clamp((d - farthest) * scale, 0.f, 255.f) : 0.f;
      const auto grey = static_cast<std::uint8_t>(nearness + 0.5f);
      return Rgb8{grey, grey, grey};
    });
  }
  return both;
}

}  // namespace wheatstone
