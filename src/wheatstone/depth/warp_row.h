#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace wheatstone {

/// Neighbours that differ by more than this are different surfaces.
inline constexpr float joined_px = 1;

/// Without SSE 4.1, which not every processor has, std::floor is a call for every pixel.
inline int floor_of(float value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<float>(truncated) ? 1 : 0);
}

/// Where the pixels of a scan line land in that of another view, `separation` eye separations to the right, in which
/// its first pixel has the column `left_px` before it is moved.
struct MovedRow {
  MovedRow(float separation_, int left_px)
      : separation(separation_), first_centre(static_cast<float>(left_px) + 0.5f) {}

  float place_of(int x, float disparity) const { return static_cast<float>(x) + first_centre - separation * disparity; }
  /// False where a disparity is unknown, or moves a pixel nowhere near the picture.
  static bool is_near(float place) { return std::abs(place) < 1e9f; }

  // The first and the last pixel whose centres lie from one place to another.
  static int first_centre_from(float place) { return -floor_of(0.5f - place); }
  static int last_centre_to(float place) { return floor_of(place - 0.5f); }

  float separation, first_centre;
};

/// At the fraction t from one pixel to the next; at its end exactly what is there.
inline float disparity_between(float here, float next, float t) { return t < 1 ? here + t * (next - here) : next; }

/// Calls `land(x_in_other, disparity, x, t)` for every pixel centre of another view's scan line that the surface of
/// this one covers: between the pixels x and x + 1, at the fraction t. The other view is `separation` eye separations
/// to the right. Not z-tested; a pixel may be landed on often. Every pixel lands at least where it is (`every_pixel`),
/// or only those at a surface's edges, which is all that the surface between its pixels does not cover. `shown_width`
/// is the other line's, in which this one's first pixel has the column `left_px` before it is moved.
template <bool every_pixel = true, class Land>
void warp_row(std::span<const float> disparity, float separation, int shown_width, int left_px, Land land) {
  const MovedRow moved(separation, left_px);
  const int width = static_cast<int>(disparity.size());
  const auto land_inside = [&](int target, float d, int x, float t) {
    if (target >= 0 && target < shown_width) land(target, d, x, t);
  };
  bool joined_before = false;
  for (int x = 0; x < width; ++x) {
    const bool joined_after = x + 1 < width && std::abs(disparity[x + 1] - disparity[x]) <= joined_px;
    const bool at_edge = !(joined_before && joined_after);
    joined_before = joined_after;
    const float here = moved.place_of(x, disparity[x]);
    if (!MovedRow::is_near(here)) continue;
    if (every_pixel || at_edge) land_inside(floor_of(here), disparity[x], x, 0);
    if (!joined_after) continue;

    // The surface between two pixels covers the centres between the places where they land.
    const float next = moved.place_of(x + 1, disparity[x + 1]);
    const int last = MovedRow::last_centre_to(next);
    for (int target = MovedRow::first_centre_from(here); target <= last; ++target) {
      const float t = next > here ? (static_cast<float>(target) + 0.5f - here) / (next - here) : 0;
      land_inside(target, disparity_between(disparity[x], disparity[x + 1], t), x, t);
    }
  }
}

enum class Landing : bool { every_pixel, edges_and_surfaces };

/// The disparity of a part of a scan line, whose first pixel is the column `left_px` of another view's line, carried
/// over what is there already: what is nearer stays; NaN is farther than anything. That view is `separation` eye
/// separations to the right. What lands is what warp_row lands.
void warp_disparity_row_over(std::span<const float> disparity, float separation, int left_px, std::span<float> nearest,
                             Landing landing = Landing::every_pixel);

/// For each pixel of a scan line that others land on: between which pixels of another line it lies, and how far.
struct LandedFrom {
  std::span<std::int32_t> x;
  std::span<float> t;
};

/// The same of edges and surfaces, and where it comes from; that stays where nothing lands.
void warp_disparity_row_over(std::span<const float> disparity, float separation, int left_px, std::span<float> nearest,
                             const LandedFrom& from);

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
