#include "wheatstone/stereo/warp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "wheatstone/depth/warp_row.h"

namespace wheatstone {
namespace {

template <bool every_pixel = true, class Land>
void warp_row(std::span<const float> disparity, float separation, Land land) {
  warp_row<every_pixel>(disparity, separation, static_cast<int>(disparity.size()), 0, land);
}

Rgb8 blend(Rgb8 a, Rgb8 b, float t) {
  const int share = static_cast<int>(256 * t + 0.5f);
  const auto mix = [share](int from, int to) {
    return static_cast<std::uint8_t>((256 * from + share * (to - from) + 128) >> 8);
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

}  // namespace

void warp_disparity_over(ImageView<const float> disparity, ViewPosition from, ViewPosition to, Image<float>& nearest) {
  tbb::parallel_for(0, disparity.height(),
                    [&](int y) { warp_disparity_row_over(disparity.row(y), to - from, 0, nearest.row(y)); });
}

Image<float> warp_disparity(ImageView<const float> disparity, ViewPosition from, ViewPosition to) {
  Image<float> warped(disparity.width(), disparity.height(), std::numeric_limits<float>::quiet_NaN());
  warp_disparity_over(disparity, from, to, warped);
  return warped;
}

WarpedPicture warp_picture(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition from,
                           ViewPosition to) {
  const int width = picture.width();
  WarpedPicture warped{Image<Rgb8>(width, picture.height()), Image<std::uint8_t>(width, picture.height())};
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height()), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(width);
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, -std::numeric_limits<float>::infinity());
      const auto colours = picture.row(y);
      const auto row = warped.picture.row(y);
      const auto covered = warped.covered.row(y);
      warp_row(disparity.row(y), to - from, [&](int target, float d, int x, float t) {
        if (d <= nearest[target]) return;
        nearest[target] = d;
        row[target] = t > 0 ? blend(colours[x], colours[x + 1], t) : colours[x];
        covered[target] = 255;
      });
    }
  });
  return warped;
}

WarpedColumns warp_columns(ImageView<const float> disparity, ViewPosition from, ViewPosition to) {
  constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
  WarpedColumns warped{Image<float>(disparity.width(), disparity.height(), nowhere),
                       Image<float>(disparity.width(), disparity.height(), nowhere)};
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto column = warped.column.row(y), nearest = warped.disparity.row(y);
    warp_row(disparity.row(y), to - from, [&](int target, float d, int x, float t) {
      if (nearest[target] >= d) return;
      nearest[target] = d;
      column[target] = static_cast<float>(x) + t;
    });
  });
  return warped;
}

void warp_picture_over(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition from,
                       float tolerance_px, Composition& composition) {
  const float separation = composition.position - from;
  const int shown_width = composition.picture.width();
  constexpr float farthest = -std::numeric_limits<float>::infinity();
  /// Between which pixels of the other picture's row a place lies, and how far.
  struct Source {
    int x;
    float t;
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height()), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(shown_width);
    std::vector<Source> sources(shown_width);
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, farthest);
      warp_row<false>(disparity.row(y), separation, shown_width, -composition.left_px,
                      [&](int target, float d, int x, float t) {
                        if (d <= nearest[target]) return;
                        nearest[target] = d;
                        sources[target] = {x, t};
                      });
      const auto colours = picture.row(y);
      const auto to = composition.picture.row(y);
      const auto there = composition.nearest.row(y);
      for (std::size_t x = 0; x < nearest.size(); ++x) {
        if (nearest[x] == farthest || there[x] + tolerance_px >= nearest[x]) continue;
        const auto [column, t] = sources[x];
        to[x] = t > 0 ? blend(colours[column], colours[column + 1], t) : colours[column];
        there[x] = nearest[x];
      }
    }
  });
}

void lay_over(const WarpedPicture& warped, Image<Rgb8>& picture) {
  tbb::parallel_for(0, picture.height(), [&](int y) {
    const auto from = warped.picture.row(y);
    const auto covered = warped.covered.row(y);
    const auto to = picture.row(y);
    for (int x = 0; x < picture.width(); ++x)
      if (covered[x] != 0) to[x] = from[x];
  });
}

}  // namespace wheatstone
