#include "wheatstone/stereo/warp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wheatstone {
namespace {

/// Neighbours that differ by more than this are different surfaces.
constexpr float joined_px = 1;

/// Without SSE 4.1, which not every processor has, std::floor is a call for every pixel.
int floor_of(float value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<float>(truncated) ? 1 : 0);
}

/// Calls `land(x_in_other, disparity, x, t)` for every pixel centre of another view's scan line that the surface of
/// this one covers: between the pixels x and x + 1, at the fraction t. The other view is `separation` eye separations
/// to the right. Not z-tested; a pixel may be landed on often. Every pixel lands at least where it is (`every_pixel`),
/// or only those at a surface's edges, which is all that the surface between its pixels does not cover.
template <bool every_pixel = true, class Land>
void warp_row(std::span<const float> disparity, float separation, Land land) {
  const auto target_of = [separation](int x, float d) { return static_cast<float>(x) + 0.5f - separation * d; };
  const int width = static_cast<int>(disparity.size());
  const auto land_inside = [&](int target, float d, int x, float t) {
    if (target >= 0 && target < width) land(target, d, x, t);
  };
  bool joined_before = false;
  for (int x = 0; x < width; ++x) {
    const bool joined_after = x + 1 < width && std::abs(disparity[x + 1] - disparity[x]) <= joined_px;
    const bool at_edge = !(joined_before && joined_after);
    joined_before = joined_after;
    const float here = target_of(x, disparity[x]);
    if (!(std::abs(here) < 1e9f)) continue;  // unknown, or nowhere near the picture
    if (every_pixel || at_edge) land_inside(floor_of(here), disparity[x], x, 0);
    if (!joined_after) continue;

    // The surface between two pixels covers the centres between the places where they land.
    const float next = target_of(x + 1, disparity[x + 1]);
    const int first = -floor_of(0.5f - here), last = floor_of(next - 0.5f);
    for (int target = first; target <= last; ++target) {
      const float t = next > here ? (static_cast<float>(target) + 0.5f - here) / (next - here) : 0;
      land_inside(target, disparity[x] + t * (disparity[x + 1] - disparity[x]), x, t);
    }
  }
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
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto row = nearest.row(y);
    warp_row(disparity.row(y), to - from, [&](int target, float d, int, float) {
      if (!(row[target] >= d)) row[target] = d;
    });
  });
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
  constexpr float farthest = -std::numeric_limits<float>::infinity();
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height()), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(picture.width());
    std::vector<Rgb8> warped(picture.width());
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, farthest);
      const auto colours = picture.row(y);
      warp_row<false>(disparity.row(y), separation, [&](int target, float d, int x, float t) {
        if (d <= nearest[target]) return;
        nearest[target] = d;
        warped[target] = t > 0 ? blend(colours[x], colours[x + 1], t) : colours[x];
      });
      const auto to = composition.picture.row(y);
      const auto there = composition.nearest.row(y);
      for (std::size_t x = 0; x < nearest.size(); ++x) {
        if (nearest[x] == farthest || there[x] + tolerance_px >= nearest[x]) continue;
        to[x] = warped[x];
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
