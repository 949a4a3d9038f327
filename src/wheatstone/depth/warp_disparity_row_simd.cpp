#include <algorithm>
#include <cmath>
#include <span>

#include "wheatstone/depth/warp_row.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/depth/warp_disparity_row_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;

enum class Kept : bool { disparity, sources };

/// A scan line and where it goes.
struct RowToWarp {
  std::span<const float> disparity;
  MovedRow moved;
  std::span<float> nearest;
  LandedFrom from = {};

  float place_of(int x) const { return moved.place_of(x, disparity[x]); }
  /// The pixel x, or a place between it and the next.
  template <Kept kept>
  HWY_INLINE void land(int target, int x, float t, float d) const {
    if (target < 0 || target >= static_cast<int>(nearest.size()) || nearest[target] >= d) return;
    nearest[target] = d;
    if constexpr (kept == Kept::sources) {
      from.x[target] = x;
      from.t[target] = t;
    }
  }
  /// Pixels of one disparity, of which nothing else is to be kept.
  void land_equal(int first, int last, float d) const {
    last = std::min(last, static_cast<int>(nearest.size()) - 1);
    for (int target = std::max(first, 0); target <= last; ++target)
      nearest[target] = nearest[target] >= d ? nearest[target] : d;
  }
  bool is_joined(int x) const {
    return x + 1 < static_cast<int>(disparity.size()) && std::abs(disparity[x + 1] - disparity[x]) <= joined_px;
  }
};

/// Lands the surface between some pixels and the next, as long as it lands a pixel for each of them, side by side,
/// which it does nearly everywhere. Returns for how many of a vector.
template <Kept kept>
HWY_INLINE int land_side_by_side(const RowToWarp& row, int x) {
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  const auto d = hn::LoadU(f, &row.disparity[x]), next_d = hn::LoadU(f, &row.disparity[x + 1]);
  const auto column = hn::ConvertTo(f, hn::Add(hn::Set(integers, x), hn::Iota(integers, 0)));
  const auto place_of = [&](auto columns, auto disparity) {
    return hn::Sub(hn::Add(columns, hn::Set(f, row.moved.first_centre)),
                   hn::Mul(hn::Set(f, row.moved.separation), disparity));
  };
  const auto half = hn::Set(f, 0.5f), one = hn::Set(f, 1.f);
  const auto here = place_of(column, d), next = place_of(hn::Add(column, one), next_d);
  const auto target = hn::Ceil(hn::Sub(here, half)), end = hn::Ceil(hn::Sub(next, half));
  const float first = hn::GetLane(target);
  if (!(first >= 0 && first + static_cast<float>(hn::Lanes(f)) <= static_cast<float>(row.nearest.size()))) return 0;
  const auto expected = hn::Add(hn::Set(f, first), hn::ConvertTo(f, hn::Iota(integers, 0)));
  const auto is_joined = hn::Le(hn::Abs(hn::Sub(next_d, d)), hn::Set(f, joined_px));
  const auto lands = hn::And(is_joined, hn::And(hn::Eq(target, expected), hn::Eq(end, hn::Add(expected, one))));
  const auto t = hn::Div(hn::Sub(hn::Add(target, half), here), hn::Sub(next, here));
  const auto landed = hn::Add(d, hn::Mul(t, hn::Sub(next_d, d)));
  const auto land = [&](auto wanted) {
    const auto to = static_cast<std::size_t>(static_cast<int>(first));
    const auto before = hn::LoadU(f, &row.nearest[to]);
    const auto is_nearer = hn::And(wanted, hn::Not(hn::Ge(before, landed)));
    hn::StoreU(hn::IfThenElse(is_nearer, landed, before), f, &row.nearest[to]);
    if constexpr (kept == Kept::sources) {
      const auto columns = hn::Add(hn::Set(integers, x), hn::Iota(integers, 0));
      hn::BlendedStore(columns, hn::RebindMask(integers, is_nearer), integers, &row.from.x[to]);
      hn::BlendedStore(t, is_nearer, f, &row.from.t[to]);
    }
  };
  // Where the next vector begins does not wait for this one to be known.
  if (HWY_LIKELY(hn::AllTrue(f, lands))) {
    land(lands);
    return static_cast<int>(hn::Lanes(f));
  }
  const std::size_t count = hn::FindKnownFirstTrue(f, hn::Not(lands));
  land(hn::FirstN(f, count));
  return static_cast<int>(count);
}

/// Lands the surface between a pixel and the next.
template <Kept kept>
HWY_INLINE void land_between(const RowToWarp& row, int x) {
  const float d = row.disparity[x], next_d = row.disparity[x + 1], here = row.place_of(x), next = row.place_of(x + 1);
  const int last = MovedRow::last_centre_to(next);
  for (int target = MovedRow::first_centre_from(here); target <= last; ++target) {
    const float t = next > here ? (static_cast<float>(target) + 0.5f - here) / (next - here) : 0;
    row.land<kept>(target, x, t, disparity_between(d, next_d, t));
  }
}

/// Lands pixels of equal disparity, which move as one, and the surface between the last of them and the next.
template <bool every_pixel, Kept kept>
HWY_INLINE void land_equal(const RowToWarp& row, int begin, int end, bool joined_before) {
  const float d = row.disparity[begin], from = row.place_of(begin), to = row.place_of(end - 1);
  if (!MovedRow::is_near(from) || !MovedRow::is_near(to)) return;
  const bool joined_after = row.is_joined(end - 1), is_single = begin + 1 == end;
  if (every_pixel || !joined_before || (is_single && !joined_after)) row.land<kept>(floor_of(from), begin, 0, d);
  if (every_pixel || (!is_single && !joined_after)) row.land<kept>(floor_of(to), end - 1, 0, d);
  if (!is_single) row.land_equal(MovedRow::first_centre_from(from), MovedRow::last_centre_to(to), d);
  if (joined_after) land_between<kept>(row, end - 1);
}

template <bool every_pixel, Kept kept>
void warp(const RowToWarp& row) {
  const int width = static_cast<int>(row.disparity.size()), lanes = static_cast<int>(hn::Lanes(Floats()));
  bool joined_before = false;
  for (int x = 0; x < width;) {
    const int landed = !every_pixel && joined_before && x + lanes < width ? land_side_by_side<kept>(row, x) : 0;
    if (landed > 0) {
      x += landed;
      const float place = row.place_of(x);  // the vector ended before it
      if (const int at = MovedRow::first_centre_from(place); at == MovedRow::last_centre_to(place))
        row.land<kept>(at, x, 0, row.disparity[x]);
      continue;
    }
    int end = x + 1;
    if constexpr (kept == Kept::disparity)
      while (end < width && row.disparity[end] == row.disparity[x]) ++end;
    land_equal<every_pixel, kept>(row, x, end, joined_before);
    joined_before = row.is_joined(end - 1);
    x = end;
  }
}

void warp_every_pixel(std::span<const float> disparity, const MovedRow& moved, std::span<float> nearest) {
  warp<true, Kept::disparity>({disparity, moved, nearest});
}

void warp_edges_and_surfaces(std::span<const float> disparity, const MovedRow& moved, std::span<float> nearest) {
  warp<false, Kept::disparity>({disparity, moved, nearest});
}

void warp_keeping_sources(std::span<const float> disparity, const MovedRow& moved, std::span<float> nearest,
                          const LandedFrom& from) {
  warp<false, Kept::sources>({disparity, moved, nearest, from});
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(warp_every_pixel);
HWY_EXPORT(warp_edges_and_surfaces);
HWY_EXPORT(warp_keeping_sources);

void warp_disparity_row_over(std::span<const float> disparity, float separation, int left_px, std::span<float> nearest,
                             Landing landing) {
  const MovedRow moved(separation, left_px);
  if (landing == Landing::every_pixel)
    HWY_DYNAMIC_DISPATCH(warp_every_pixel)(disparity, moved, nearest);
  else
    HWY_DYNAMIC_DISPATCH(warp_edges_and_surfaces)(disparity, moved, nearest);
}

void warp_disparity_row_over(std::span<const float> disparity, float separation, int left_px, std::span<float> nearest,
                             const LandedFrom& from) {
  HWY_DYNAMIC_DISPATCH(warp_keeping_sources)(disparity, MovedRow(separation, left_px), nearest, from);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
