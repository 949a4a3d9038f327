#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "wheatstone/strokes/depth_edges_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/strokes/depth_edges_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int widest_vector = 64;
using Steps = hn::CappedTag<std::int16_t, widest_vector / 2>;
using Bytes = hn::CappedTag<std::uint8_t, widest_vector>;
using Integers = hn::CappedTag<std::int32_t, widest_vector / 4>;

/// The nearest and the farthest of some rows' disparities.
struct Extremes {
  Extremes(int rows, int stride_) : stride(stride_), nearest(size_of(rows)), farthest(size_of(rows)) {}
  std::size_t size_of(int rows) const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride) + widest_vector;
  }

  int stride;
  std::vector<std::int16_t> nearest, farthest;
};

/// Replaces each of the first `count` pairs by the extremes of itself and of the pair `step` later.
void widen(std::size_t count, std::size_t step, std::int16_t* nearest, std::int16_t* farthest) {
  const Steps s;
  for (std::size_t i = 0; i < count; i += hn::Lanes(s)) {
    hn::StoreU(hn::Max(hn::LoadU(s, nearest + i), hn::LoadU(s, nearest + i + step)), s, nearest + i);
    hn::StoreU(hn::Min(hn::LoadU(s, farthest + i), hn::LoadU(s, farthest + i + step)), s, farthest + i);
  }
}

/// Replaces each of `count` pairs by the extremes of the `window` pairs from it on, which are `unit` apart. Each pass
/// doubles their number.
void look_ahead(int window, std::size_t unit, std::size_t count, std::int16_t* nearest, std::int16_t* farthest) {
  int seen = 1;
  for (; 2 * seen <= window; seen *= 2) {
    const std::size_t needed = count + static_cast<std::size_t>(window - 2 * seen) * unit;
    widen(needed, static_cast<std::size_t>(seen) * unit, nearest, farthest);
  }
  if (seen < window) widen(count, static_cast<std::size_t>(window - seen) * unit, nearest, farthest);
}

/// Finds the extremes of the windows, of `reach` columns on both sides, around the columns of each row in
/// [first, end), and of `rows_reach` rows more on both sides, within the picture.
void look_at_rows(ImageView<const std::int16_t> steps, int reach, int rows_reach, int first, int end,
                  Extremes& extremes) {
  std::ranges::fill(extremes.nearest, std::numeric_limits<std::int16_t>::min());
  std::ranges::fill(extremes.farthest, std::numeric_limits<std::int16_t>::max());
  const auto width = static_cast<std::size_t>(steps.width());
  for (int y = std::max(first - rows_reach, 0); y < std::min(end + rows_reach, steps.height()); ++y) {
    const std::size_t at = static_cast<std::size_t>(y - first + rows_reach) * static_cast<std::size_t>(extremes.stride);
    std::int16_t* const nearest = extremes.nearest.data() + at;
    std::int16_t* const farthest = extremes.farthest.data() + at;
    std::ranges::copy(steps.row(y), nearest + reach);
    std::ranges::copy(steps.row(y), farthest + reach);
    look_ahead(2 * reach + 1, 1, width, nearest, farthest);
  }
}

void mark(const DepthEdgeMarks& wanted, int first, int end, Image<std::uint8_t>& marks) {
  const Steps s;
  const hn::Rebind<std::uint8_t, Steps> bytes;
  const int lanes = static_cast<int>(hn::Lanes(s)), reach = wanted.reach_px, width = marks.width();
  const int rows_reach = std::min(reach, marks.height());  // less than a broad brush's, in a panorama
  // Rows are padded so far that what passes over a row's end leaves the next one's columns alone.
  Extremes extremes(end - first + 2 * rows_reach, width + 2 * reach + widest_vector);
  const auto stride = static_cast<std::size_t>(extremes.stride);
  look_at_rows(wanted.steps, reach, rows_reach, first, end, extremes);
  look_ahead(2 * rows_reach + 1, stride, static_cast<std::size_t>(end - first) * stride, extremes.nearest.data(),
             extremes.farthest.data());
  const auto threshold = hn::Set(s, wanted.threshold);
  std::vector<std::int16_t> own_row(static_cast<std::size_t>(width) + widest_vector);
  std::vector<std::uint8_t> marked(own_row.size());
  for (int y = first; y < end; ++y) {
    std::ranges::copy(wanted.steps.row(y), own_row.begin());
    const std::size_t at = static_cast<std::size_t>(y - first) * stride;
    for (int x = 0; x < width; x += lanes) {
      const auto own = hn::LoadU(s, own_row.data() + x);
      auto jump = hn::SaturatedSub(hn::LoadU(s, extremes.nearest.data() + at + x), own);
      if (!wanted.only_behind)
        jump = hn::Max(jump, hn::SaturatedSub(own, hn::LoadU(s, extremes.farthest.data() + at + x)));
      const auto is_marked = hn::IfThenElseZero(hn::Gt(jump, threshold), hn::Set(s, 255));
      hn::StoreU(hn::DemoteTo(bytes, is_marked), bytes, marked.data() + x);
    }
    std::copy_n(marked.begin(), width, marks.row(y).begin());
  }
}

/// The columns from each pixel of a row to the nearest edge; 255 where there is none within `reach`. `edges` goes on
/// for `reach` columns and a vector on both sides.
void find_columns_to_edge(const std::uint8_t* edges, int width, int reach, std::uint8_t* columns) {
  const Bytes b;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(b))) {
    auto nearest = hn::Set(b, 255);
    for (int away = reach; away >= 0; --away) {
      const auto here = hn::Or(hn::LoadU(b, edges + x - away), hn::LoadU(b, edges + x + away));
      nearest = hn::IfThenElse(hn::Eq(here, hn::Zero(b)), nearest, hn::Set(b, static_cast<std::uint8_t>(away)));
    }
    hn::StoreU(nearest, b, columns + x);
  }
}

/// Lowers a row's distances to those of the edges of another row, so many rows away.
void lower_to_row(const std::uint8_t* columns, int rows_away, int width, std::int32_t* distances) {
  const Integers i32;
  const hn::Rebind<std::uint8_t, Integers> bytes;
  const auto rows = hn::Set(i32, rows_away), straight = hn::Set(i32, ChamferSteps::straight),
             aslant = hn::Set(i32, ChamferSteps::diagonal - ChamferSteps::straight);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(i32))) {
    const auto across = hn::PromoteTo(i32, hn::LoadU(bytes, columns + x));
    const auto distance = hn::Add(hn::Mul(hn::Max(across, rows), straight), hn::Mul(hn::Min(across, rows), aslant));
    hn::StoreU(hn::Min(hn::LoadU(i32, distances + x), distance), i32, distances + x);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(mark);
HWY_EXPORT(find_columns_to_edge);
HWY_EXPORT(lower_to_row);

void mark_depth_edges(const DepthEdgeMarks& wanted, int first_row, int end_row, Image<std::uint8_t>& marks) {
  HWY_DYNAMIC_DISPATCH(mark)(wanted, first_row, end_row, marks);
}

void measure_edge_distances(ImageView<const std::uint8_t> edges, float most_px, int first_row,
                            ImageView<float> distances) {
  constexpr int widest_vector = 64, no_edge = std::numeric_limits<std::int32_t>::max();
  const int width = edges.width(), reach = static_cast<int>(std::ceil(most_px));
  const int end_row = first_row + distances.height();
  const int top = std::max(first_row - reach, 0), bottom = std::min(end_row + reach, edges.height());
  const auto padded = static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(reach + widest_vector);
  std::vector<std::uint8_t> row(padded), columns(padded * static_cast<std::size_t>(bottom - top));
  std::vector<std::uint8_t> has_edge(static_cast<std::size_t>(bottom - top));
  const auto columns_of = [&](int y) { return columns.data() + padded * static_cast<std::size_t>(y - top); };
  for (int y = top; y < bottom; ++y) {
    const auto from = edges.row(y);
    if (std::ranges::find(from, 255) == from.end()) continue;
    has_edge[static_cast<std::size_t>(y - top)] = 1;
    std::ranges::copy(from, row.begin() + reach + widest_vector);
    HWY_DYNAMIC_DISPATCH(find_columns_to_edge)(row.data() + reach + widest_vector, width, reach, columns_of(y));
  }
  std::vector<std::int32_t> steps(padded);
  for (int y = first_row; y < end_row; ++y) {
    std::ranges::fill(steps, no_edge);
    for (int other = std::max(y - reach, top); other < std::min(y + reach + 1, bottom); ++other)
      if (has_edge[static_cast<std::size_t>(other - top)] != 0)
        HWY_DYNAMIC_DISPATCH(lower_to_row)(columns_of(other), std::abs(other - y), width, steps.data());
    const auto to = distances.row(y - first_row);
    for (int x = 0; x < width; ++x) {
      const float distance = static_cast<float>(steps[static_cast<std::size_t>(x)]) / ChamferSteps::one_px + 0.5f;
      to[x] = distance < most_px ? distance : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

}  // namespace wheatstone
#endif  // HWY_ONCE
