#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace wheatstone {

/// Neighbours that differ by more than this are different surfaces.
inline constexpr float joined_px = 1;

/// Without SSE 4.1, which not every processor has, std::floor is a call for every pixel.
inline int floor_of(float value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<float>(truncated) ? 1 : 0);
}

/// Calls `land(x_in_other, disparity, x, t)` for every pixel centre of another view's scan line that the surface of
/// this one covers: between the pixels x and x + 1, at the fraction t. The other view is `separation` eye separations
/// to the right. Not z-tested; a pixel may be landed on often. Every pixel lands at least where it is (`every_pixel`),
/// or only those at a surface's edges, which is all that the surface between its pixels does not cover. `shown_width`
/// is the other line's, in which this one's first pixel has the column `left_px` before it is moved.
template <bool every_pixel = true, class Land>
void warp_row(std::span<const float> disparity, float separation, int shown_width, int left_px, Land land) {
  const float first_centre = static_cast<float>(left_px) + 0.5f;
  const auto target_of = [separation, first_centre](int x, float d) {
    return static_cast<float>(x) + first_centre - separation * d;
  };
  const int width = static_cast<int>(disparity.size());
  const auto land_inside = [&](int target, float d, int x, float t) {
    if (target >= 0 && target < shown_width) land(target, d, x, t);
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

/// The disparity of a part of a scan line, whose first pixel is the column `left_px` of another view's line, carried
/// over what is there already: what is nearer stays; NaN is farther than anything. That view is `separation` eye
/// separations to the right.
template <bool every_pixel = true>
void warp_disparity_row_over(std::span<const float> disparity, float separation, int left_px,
                             std::span<float> nearest) {
  warp_row<every_pixel>(disparity, separation, static_cast<int>(nearest.size()), left_px,
                        [&](int target, float d, int, float) {
                          if (!(nearest[target] >= d)) nearest[target] = d;
                        });
}

/// Gives unknown runs of a scan line of at most two pixels, which a surface that is stretched leaves, the smaller
/// disparity of their two neighbours.
inline void close_cracks(std::span<float> row) {
  constexpr std::size_t widest_px = 2;
  for (std::size_t begin = 1; begin + 1 < row.size(); ++begin) {
    if (!std::isnan(row[begin]) || std::isnan(row[begin - 1])) continue;
    std::size_t end = begin;
    while (end < row.size() && std::isnan(row[end])) ++end;
    if (end < row.size() && end - begin <= widest_px)
      std::fill(row.begin() + static_cast<std::ptrdiff_t>(begin), row.begin() + static_cast<std::ptrdiff_t>(end),
                std::min(row[begin - 1], row[end]));
    begin = end;
  }
}

}  // namespace wheatstone
