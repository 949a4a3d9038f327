#include "wheatstone/stereo/geometry_from_disparity.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/known_values.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/warp.h"

namespace wheatstone {
namespace {

/// False where the row knows nothing.
bool fill_row(std::span<float> row) {
  const auto known = [](float d) { return std::isfinite(d); };
  const auto size = row.size();
  for (std::size_t begin = 0; begin < size;) {
    if (known(row[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < size && !known(row[end])) ++end;
    if (begin == 0 && end == size) return false;
    const float before = begin > 0 ? row[begin - 1] : row[end];
    const float after = end < size ? row[end] : row[begin - 1];
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(begin), row.begin() + static_cast<std::ptrdiff_t>(end),
              std::min(before, after));
    begin = end;
  }
  return true;
}

/// 255 where a pixel's counterpart lies outside the other view, which is `separation` eye separations to the right, or
/// behind something that is nearer.
Image<std::uint8_t> find_occlusion(const Image<float>& own, const Image<float>& other, float separation,
                                   const GeometryOptions& options) {
  const int width = own.width();
  Image<std::uint8_t> occlusion(width, own.height());
  tbb::parallel_for(0, own.height(), [&](int y) {
    const auto from = own.row(y), into = other.row(y);
    const auto mask = occlusion.row(y);
    for (int x = 0; x < width; ++x) {
      const float target = std::floor(static_cast<float>(x) + 0.5f - separation * from[x]);
      const bool outside = !(target >= 0 && target < static_cast<float>(width));
      const bool hidden = !outside && into[static_cast<int>(target)] > from[x] + options.occlusion_tolerance_px;
      mask[x] = outside || hidden ? 255 : 0;
    }
  });
  remove_occlusion_specks(occlusion, options.least_occlusion_px);
  return occlusion;
}

StereoGeometry with_occlusion(Image<float> left, Image<float> right, const GeometryOptions& options) {
  StereoGeometry geometry;
  geometry.left_occlusion = find_occlusion(left, right, right_eye - left_eye, options);
  geometry.right_occlusion = find_occlusion(right, left, left_eye - right_eye, options);
  geometry.left_disparity = std::move(left);
  geometry.right_disparity = std::move(right);
  return geometry;
}

}  // namespace

void fill_from_farther_side(Image<float>& disparity) {
  check_known_anywhere(disparity, "the disparity");
  const int height = disparity.height();
  std::vector<char> known(height);
  tbb::parallel_for(0, height, [&](int y) { known[y] = fill_row(disparity.row(y)) ? 1 : 0; });
  for (int y = 0; y < height; ++y) {
    if (known[y] != 0) continue;
    int distance = 1;
    const auto has = [&](int row) { return row >= 0 && row < height && known[row] != 0; };
    while (!has(y - distance) && !has(y + distance)) ++distance;
    std::ranges::copy(disparity.row(has(y - distance) ? y - distance : y + distance), disparity.row(y).begin());
  }
}

StereoGeometry geometry_from_left(Image<float> left_disparity, const GeometryOptions& options) {
  fill_from_farther_side(left_disparity);
  Image<float> right_disparity = warp_disparity(left_disparity, left_eye, right_eye);
  fill_from_farther_side(right_disparity);
  return with_occlusion(std::move(left_disparity), std::move(right_disparity), options);
}

StereoGeometry geometry_from_both(Image<float> left_disparity, Image<float> right_disparity,
                                  const GeometryOptions& options) {
  if (!same_size(left_disparity, right_disparity))
    throw Error(ErrorKind::bad_input, fmt::format("the right disparity is {}x{} pixels, expected the left one's {}x{}",
                                                  right_disparity.width(), right_disparity.height(),
                                                  left_disparity.width(), left_disparity.height()));
  fill_from_farther_side(left_disparity);
  fill_from_farther_side(right_disparity);
  return with_occlusion(std::move(left_disparity), std::move(right_disparity), options);
}

}  // namespace wheatstone
