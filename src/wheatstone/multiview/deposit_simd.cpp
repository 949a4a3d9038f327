#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

#include "wheatstone/multiview/light_band_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/multiview/deposit_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wheatstone/multiview/fast_exp_internal.h"
#include "wheatstone/multiview/mass_splats_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A splat, unpacked. Of light, its weight at a distance is 2^(−sharpness·distance²), and 0 beyond its reach. Of mass,
/// it is the part of a Gaussian that lies over the pixel, and all of it lies within its reach: weights sum to 1,
/// wherever the splat lies between the pixels.
struct Spread {
  HWY_ALIGN float colour[4];  // of mass, both channels twice
  float reach, sharpness;
  bool spline;  // of mass: the cubic spline kernel in place of a Gaussian
};

template <Deposit deposit>
HWY_INLINE void unpack(const Splat& splat, Spread& spread) {
  const hn::CappedTag<float, 4> d4;
  const hn::Rebind<hwy::float16_t, decltype(d4)> halves;
  const hn::Rebind<std::uint16_t, decltype(d4)> bits;
  for (std::size_t i = 0; i < 4; i += hn::MaxLanes(d4))
    hn::Store(hn::PromoteTo(d4, hn::BitCast(halves, hn::LoadU(bits, splat.colour + i))), d4, spread.colour + i);
  const float size = spread.colour[3];
  spread.colour[3] = 0;
  if constexpr (deposit == Deposit::mass) {
    const float second = spread.colour[2];
    std::memcpy(spread.colour, splat.colour, sizeof(float));
    spread.colour[1] = spread.colour[0] * second;
    spread.colour[2] = spread.colour[0];
    spread.colour[3] = spread.colour[1];
  }
  if constexpr (deposit == Deposit::absorbing) {
    const float depth = spread.colour[2];
    std::uint32_t packed = 0;
    std::memcpy(&packed, splat.colour, sizeof packed);
    const std::array<float, 3> light = unpacked_light(packed);
    for (std::size_t i = 0; i < 3; ++i) spread.colour[i] = depth * light[i];
    spread.colour[3] = depth;
  }
  if constexpr (keeps_sums(deposit)) {
    spread.reach = reach_of(size);
    spread.sharpness = 2 / size;
    return;
  }
  const float variance = size * size * (1 / (diameters_a_deviation * diameters_a_deviation)) + pixel_variance;
  spread.reach = reach_of(size);
  spread.sharpness = 0.72134752f / variance;  // 1 / (2 ln 2)
}

/// Weights of pixels whose centres lie at these distances from the splat's.
template <Deposit deposit>
HWY_INLINE Vec weights_at(Vec distance, const Spread& spread) {
  const Floats d;
  if constexpr (keeps_sums(deposit)) {
    const Vec scale = hn::Set(d, spread.sharpness);
    const Vec half = hn::Set(d, 0.5f);
    return hn::Sub(half_within(hn::Mul(hn::Add(distance, half), scale), spread.spline),
                   half_within(hn::Mul(hn::Sub(distance, half), scale), spread.spline));
  }
  const Vec weight = fast_exp2(d, hn::Mul(hn::Mul(distance, distance), hn::Set(d, -spread.sharpness)));
  return hn::IfThenElseZero(hn::Le(hn::Abs(distance), hn::Set(d, spread.reach)), weight);
}

/// The same of a window's pixels, from left to right, of which the last lane's is not needed: what lies between their
/// edges is computed once for each edge.
template <Deposit deposit>
HWY_INLINE Vec weights_in_window(float distance, const Spread& spread) {
  const Floats d;
  if constexpr (!keeps_sums(deposit)) return weights_at<deposit>(hn::Iota(d, distance), spread);
  const hn::RebindToSigned<Floats> di;
  const Vec at_edge = half_within(hn::Mul(hn::Iota(d, distance - 0.5f), hn::Set(d, spread.sharpness)), spread.spline);
  const auto next = hn::IndicesFromVec(d, hn::Min(hn::Iota(di, 1), hn::Set(di, static_cast<int>(lanes) - 1)));
  return hn::Sub(hn::TableLookupLanes(at_edge, next), at_edge);
}

/// Weights of `count` pixels or more; the centre of the first is at `distance` from the splat's.
template <Deposit deposit>
HWY_INLINE void weigh(float distance, const Spread& spread, int count, float* weights) {
  const Floats d;
  if (count < lanes) return hn::Store(weights_in_window<deposit>(distance, spread), d, weights);
  for (int i = 0; i < count; i += lanes)
    hn::Store(weights_at<deposit>(hn::Iota(d, distance + static_cast<float>(i)), spread), d, weights + i);
}

/// The light of a row of pixels, all four channels: their weights times the colour. The first pixel's centre is at
/// `distance` from the splat's.
template <Deposit deposit, int pixels>
HWY_INLINE void light_row(const Spread& spread, float distance, Vec (&light)[pixels * 4 / lanes]) {
  const Floats d;
  if constexpr (lanes == 16) {
    const Vec weights = pixels < lanes ? weights_in_window<deposit>(distance, spread)
                                       : weights_at<deposit>(hn::Iota(d, distance), spread);
    const Vec colour = hn::LoadDup128(d, spread.colour);
    const auto pixel = hn::ShiftRight<2>(hn::Iota(hn::RebindToSigned<Floats>(), 0));
    for (int i = 0; i < pixels / 4; ++i) {
      const auto each = hn::IndicesFromVec(d, hn::Add(pixel, hn::Set(hn::RebindToSigned<Floats>(), 4 * i)));
      light[i] = hn::Mul(hn::TableLookupLanes(weights, each), colour);
    }
  } else {
    HWY_ALIGN float weights[(pixels + lanes - 1) / lanes * lanes];
    HWY_ALIGN float values[pixels * 4];
    weigh<deposit>(distance, spread, pixels, weights);
    for (int i = 0; i < pixels * 4; ++i) values[i] = weights[i / 4] * spread.colour[i % 4];
    for (int i = 0; i < pixels * 4 / lanes; ++i) light[i] = hn::Load(d, values + i * lanes);
  }
}

/// The rows that a splat touches. Small splats have windows of four, six or eight rows, moved into the band where they
/// would stick out: so all counts are known, and no branch is mispredicted.
struct RowWindow {
  int first, count;
  HWY_ALIGN float weights[most_rows];
};

/// Adds rows of pixels to a band, the upper left one at `to`. `fixed_rows` of 0 stands for `rows.count`.
template <int fixed_rows, int vectors>
HWY_INLINE void add_rows(const Vec (&light)[vectors], const RowWindow& rows, std::ptrdiff_t stride, float* to) {
  const Floats d;
  const int end = fixed_rows > 0 ? fixed_rows : rows.count;
  HWY_UNROLL(8)
  for (int row = 0; row < end; ++row, to += stride) {
    const Vec share = hn::Set(d, rows.weights[row]);
    for (int i = 0; i < vectors; ++i)
      hn::Store(hn::MulAdd(share, light[i], hn::Load(d, to + i * lanes)), d, to + i * lanes);
  }
}

template <Deposit deposit>
HWY_INLINE void find_rows(const Splat& splat, const Spread& spread, int top, int band_rows, RowWindow& rows) {
  const float y = splat.y - static_cast<float>(top) - 0.5f;
  const int first = rounded_up(y - spread.reach);
  const int end = static_cast<int>(y + spread.reach + 1);
  rows.count = spread.reach < 2   ? 4
               : spread.reach < 3 ? 6
               : spread.reach < 4 ? 8
                                  : std::min(end, band_rows) - std::max(first, 0);
  rows.first = std::min(std::max(first, 0), band_rows - rows.count);
  const float distance = static_cast<float>(rows.first) - y;
  if constexpr (deposit == Deposit::mass)
    return find_parts(distance - 0.5f, spread.sharpness, spread.spline, rows.count, rows.weights);
  weigh<deposit>(distance, spread, rows.count, rows.weights);
}

/// Adds rows × pixels of four channels to a band.
template <Deposit deposit, int fixed_rows, int pixels>
HWY_INLINE void add_window(const Spread& spread, float distance, const RowWindow& rows, std::ptrdiff_t stride,
                           float* to) {
  Vec light[pixels * 4 / lanes];
  light_row<deposit, pixels>(spread, distance, light);
  add_rows<fixed_rows>(light, rows, stride, to);
}

/// Adds 16 pixels of mass, their parts in memory.
template <int fixed_rows>
HWY_INLINE void add_mass_window(const float* parts, const Spread& spread, const RowWindow& rows, std::ptrdiff_t stride,
                                float* to) {
  Vec light[4 * mass_line / lanes];
  light_mass_in_memory(parts, spread.colour, light);
  add_rows<fixed_rows>(light, rows, stride, to);
}

/// Adds a splat of mass, its centre in column `x` of the band.
HWY_INLINE void add_mass(const Spread& spread, const RowWindow& rows, float x, LightBand& band) {
  const int touched = rounded_up(x - spread.reach - 0.5f);
  const int end = static_cast<int>(x + spread.reach + 0.5f);
  const int first = touched & ~(mass_line - 1);
  float* const to = band.row(rows.first) + first * channels_in(Deposit::mass);
  const float first_edge = static_cast<float>(touched) - x;
  const std::ptrdiff_t stride = band.stride();
  if constexpr (lanes == 16) {
    if (end - touched < lanes) {
      const Vec parts = parts_from(first_edge, spread.sharpness, spread.spline);
      if (end - first > 2 * mass_line) {
        Vec light[3];
        light_mass(parts, touched - first, spread.colour, light);
        return add_rows<0>(light, rows, stride, to);
      }
      Vec light[2];
      light_mass(parts, touched - first, spread.colour, light);
      if (spread.reach < 2) return add_rows<4>(light, rows, stride, to);
      if (spread.reach < 3) return add_rows<6>(light, rows, stride, to);
      if (spread.reach < 4) return add_rows<8>(light, rows, stride, to);
      return add_rows<0>(light, rows, stride, to);
    }
  }
  HWY_ALIGN float parts[most_rows + 2 * mass_line + lanes] = {};
  find_parts(first_edge, spread.sharpness, spread.spline, end - touched, parts + (touched - first));
  if (spread.reach < 2) return add_mass_window<4>(parts, spread, rows, stride, to);
  if (spread.reach < 3) return add_mass_window<6>(parts, spread, rows, stride, to);
  if (spread.reach < 4) return add_mass_window<8>(parts, spread, rows, stride, to);
  for (int column = 0; column < end - first; column += 2 * mass_line)
    add_mass_window<0>(parts + column, spread, rows, stride, to + column * channels_in(Deposit::mass));
}

/// Adds a splat, its centre in column `x` of the band.
template <Deposit deposit>
HWY_INLINE void add(const Spread& spread, const RowWindow& rows, float x, LightBand& band) {
  if constexpr (deposit == Deposit::mass) return add_mass(spread, rows, x, band);
  const int first = rounded_up(x - spread.reach - 0.5f) & ~3;  // of a cache line
  float* const to = band.row(rows.first) + first * 4;
  const float distance = static_cast<float>(first) + 0.5f - x;
  const std::ptrdiff_t stride = band.stride();
  if (spread.reach < 2) return add_window<deposit, 4, 8>(spread, distance, rows, stride, to);
  if (spread.reach < 3) return add_window<deposit, 6, 12>(spread, distance, rows, stride, to);
  if (spread.reach < 4) return add_window<deposit, 8, 12>(spread, distance, rows, stride, to);
  const int columns = static_cast<int>(x + spread.reach + 0.5f) - first;
  for (int column = 0; column < columns; column += 16)
    add_window<deposit, 0, 16>(spread, distance + static_cast<float>(column), rows, stride, to + column * 4);
}

void deposit_mass(std::span<const Splat> splats, int top, bool spline, LightBand& band) {
  MassSplats ready;
  while (!splats.empty()) {
    const std::span<const Splat> some = splats.first(std::min(splats.size(), MassSplats::most));
    make_ready(some, top, spline, band, ready);
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (ready.extent[i] < most_parts) {
        add_lines<2>(ready, i, 0, band);
        if (ready.columns_end[i] > 2 * mass_line) add_lines<1>(ready, i, 2, band);
        continue;
      }
      Spread spread;
      RowWindow rows;
      spread.spline = spline;
      unpack<Deposit::mass>(some[i], spread);
      find_rows<Deposit::mass>(some[i], spread, top, band.rows(), rows);
      add_mass(spread, rows, ready.x[i], band);
    }
    splats = splats.subspan(some.size());
  }
}

template <Deposit deposit>
void deposit_splats(std::span<const Splat> splats, int top, bool spline, LightBand& band) {
  if constexpr (deposit == Deposit::mass) return deposit_mass(splats, top, spline, band);
  RowWindow rows;
  Spread spread;
  spread.spline = spline;
  const auto left = static_cast<float>(band.left());
  for (const Splat& splat : splats) {
    unpack<deposit>(splat, spread);
    find_rows<deposit>(splat, spread, top, band.rows(), rows);
    add<deposit>(spread, rows, splat.x - left, band);
  }
}

template <Deposit deposit>
void deposit_splats_between(std::span<const Splat> splats, int top, bool spline, const PlanePair& planes,
                            LightBand& nearer, LightBand& farther) {
  constexpr float nearly = 0.25f;
  RowWindow rows;
  Spread spread;
  spread.spline = spline;
  const auto left = static_cast<float>(nearer.left());
  for (const Splat& splat : splats) {
    unpack<deposit>(splat, spread);
    find_rows<deposit>(splat, spread, top, nearer.rows(), rows);
    const float x = splat.x - left;
    const float share = (splat.parallax - planes.parallax_px) / planes.spacing_px;
    if (share <= nearly || share >= 1 - nearly) {
      add<deposit>(spread, rows, x, share < 0.5f ? nearer : farther);
      continue;
    }
    Spread part = spread;
    for (int i = 0; i < 4; ++i) part.colour[i] = spread.colour[i] * (1 - share);
    add<deposit>(part, rows, x, nearer);
    for (int i = 0; i < 4; ++i) part.colour[i] = spread.colour[i] * share;
    add<deposit>(part, rows, x, farther);
  }
}

template <Deposit deposit>
void deposit_splats_in_views(std::span<const Splat> splats, int top, bool spline, std::span<const ViewPosition> views,
                             std::span<LightBand> bands) {
  RowWindow rows;
  Spread spread;
  spread.spline = spline;
  const auto left = static_cast<float>(bands.front().left());
  const float width = static_cast<float>(bands.front().right()) - left;
  const hn::CappedTag<float, 1> d1;
  for (const Splat& splat : splats) {
    unpack<deposit>(splat, spread);
    find_rows<deposit>(splat, spread, top, bands.front().rows(), rows);
    for (std::size_t v = 0; v < views.size(); ++v) {
      // Rounded once, as the projection of that view rounds it: the views of both renderers are equal to the bit.
      const auto moved =
          hn::MulAdd(hn::Set(d1, splat.parallax), hn::Set(d1, views[v] - central_view), hn::Set(d1, splat.x));
      const float x = hn::GetLane(moved) - left;
      if (x + spread.reach > 0 && x - spread.reach < width) add<deposit>(spread, rows, x, bands[v]);
    }
  }
}

/// Calls `call` with the kind of deposit as a constant.
template <class Call>
void for_deposit(Deposit deposit, Call call) {
  switch (channels_of(deposit)) {
    case Deposit::light:
      return call(std::integral_constant<Deposit, Deposit::light>());
    case Deposit::mass:
    case Deposit::mass_by_spline:
      return call(std::integral_constant<Deposit, Deposit::mass>());
    case Deposit::colours:
    case Deposit::colours_by_spline:
      return call(std::integral_constant<Deposit, Deposit::colours>());
    case Deposit::absorbing:
      return call(std::integral_constant<Deposit, Deposit::absorbing>());
  }
}

void deposit_any(Deposit deposit, std::span<const Splat> splats, int top, LightBand& band) {
  for_deposit(deposit, [&](auto kind) { deposit_splats<kind()>(splats, top, channels_of(deposit) != deposit, band); });
}

void deposit_any_between(Deposit deposit, std::span<const Splat> splats, int top, const PlanePair& planes,
                         LightBand& nearer, LightBand& farther) {
  for_deposit(deposit, [&](auto kind) {
    deposit_splats_between<kind()>(splats, top, channels_of(deposit) != deposit, planes, nearer, farther);
  });
}

void deposit_any_in_views(Deposit deposit, std::span<const Splat> splats, int top, std::span<const ViewPosition> views,
                          std::span<LightBand> bands) {
  for_deposit(deposit, [&](auto kind) {
    deposit_splats_in_views<kind()>(splats, top, channels_of(deposit) != deposit, views, bands);
  });
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(deposit_any);
HWY_EXPORT(deposit_any_between);
HWY_EXPORT(deposit_any_in_views);

void deposit(Deposit kind, std::span<const Splat> splats, int top, LightBand& band) {
  if (splats.empty()) return;
  band.note_light();
  HWY_DYNAMIC_DISPATCH(deposit_any)(kind, splats, top, band);
}

void deposit_between(Deposit kind, std::span<const Splat> splats, int top, const PlanePair& planes, LightBand& nearer,
                     LightBand& farther) {
  if (splats.empty()) return;
  nearer.note_light();
  farther.note_light();
  HWY_DYNAMIC_DISPATCH(deposit_any_between)(kind, splats, top, planes, nearer, farther);
}

void deposit_in_views(Deposit kind, std::span<const Splat> splats, int top, std::span<const ViewPosition> views,
                      std::span<LightBand> bands) {
  if (splats.empty()) return;
  for (LightBand& band : bands) band.note_light();
  HWY_DYNAMIC_DISPATCH(deposit_any_in_views)(kind, splats, top, views, bands);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
