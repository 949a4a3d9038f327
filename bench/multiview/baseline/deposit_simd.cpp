#include <algorithm>

#include "multiview/baseline/light_band.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/baseline/deposit_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "multiview/baseline/fast_exp.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::baseline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector is a few pixels of four channels: up to four.
using Floats = hn::CappedTag<float, 16>;
using Vec = hn::Vec<Floats>;
constexpr std::ptrdiff_t lanes = hn::MaxLanes(Floats());
constexpr int most_rows = 48;

HWY_INLINE int rounded_up(float x) {
  const int whole = static_cast<int>(x);
  return whole + (static_cast<float>(whole) < x);
}

/// A splat, unpacked. Its weight at a distance is 2^(−sharpness·distance²), and 0 beyond its reach.
struct Spread {
  HWY_ALIGN float colour[4];
  float reach, sharpness;
};

HWY_INLINE void unpack(const Splat& splat, Spread& spread) {
  const hn::CappedTag<float, 4> d4;
  const hn::Rebind<hwy::float16_t, decltype(d4)> halves;
  const hn::Rebind<std::uint16_t, decltype(d4)> bits;
  for (std::size_t i = 0; i < 4; i += hn::MaxLanes(d4))
    hn::Store(hn::PromoteTo(d4, hn::BitCast(halves, hn::LoadU(bits, splat.colour + i))), d4, spread.colour + i);
  const float size = spread.colour[3];
  spread.colour[3] = 0;
  const float variance = size * size * (1 / (diameters_a_deviation * diameters_a_deviation)) + pixel_variance;
  spread.reach = reach_of(size);
  spread.sharpness = 0.72134752f / variance;  // 1 / (2 ln 2)
}

/// Weights of pixels whose centres lie at these distances from the splat's.
HWY_INLINE Vec weights_at(Vec distance, const Spread& spread) {
  const Floats d;
  const Vec weight = fast_exp2(d, hn::Mul(hn::Mul(distance, distance), hn::Set(d, -spread.sharpness)));
  return hn::IfThenElseZero(hn::Le(hn::Abs(distance), hn::Set(d, spread.reach)), weight);
}

/// Weights of `count` pixels or more; the centre of the first is at `distance` from the splat's.
HWY_INLINE void weigh(float distance, const Spread& spread, int count, float* weights) {
  const Floats d;
  for (int i = 0; i < count; i += lanes)
    hn::Store(weights_at(hn::Iota(d, distance + static_cast<float>(i)), spread), d, weights + i);
}

/// The light of a row of pixels, all channels: their weights times the colour. The first pixel's centre is at
/// `distance` from the splat's.
template <int pixels>
HWY_INLINE void light_row(const Spread& spread, float distance, Vec (&light)[pixels * LightBand::channels / lanes]) {
  const Floats d;
  if constexpr (lanes == 16) {
    const Vec weights = weights_at(hn::Iota(d, distance), spread);
    const Vec colour = hn::LoadDup128(d, spread.colour);
    const auto pixel = hn::ShiftRight<2>(hn::Iota(hn::RebindToSigned<Floats>(), 0));
    for (int i = 0; i < pixels / 4; ++i) {
      const auto each = hn::IndicesFromVec(d, hn::Add(pixel, hn::Set(hn::RebindToSigned<Floats>(), 4 * i)));
      light[i] = hn::Mul(hn::TableLookupLanes(weights, each), colour);
    }
  } else {
    HWY_ALIGN float weights[(pixels + lanes - 1) / lanes * lanes];
    HWY_ALIGN float values[pixels * LightBand::channels];
    weigh(distance, spread, pixels, weights);
    for (int i = 0; i < pixels * LightBand::channels; ++i)
      values[i] = weights[i / LightBand::channels] * spread.colour[i % LightBand::channels];
    for (int i = 0; i < pixels * LightBand::channels / lanes; ++i) light[i] = hn::Load(d, values + i * lanes);
  }
}

/// The rows that a splat touches. Small splats have windows of four, six or eight rows, moved into the band where they
/// would stick out: all counts are known, and nothing is guessed wrong.
struct RowWindow {
  int first, count;
  HWY_ALIGN float weights[most_rows];
};

/// Adds rows × pixels to a band, the upper left one at `to`. `fixed_rows` of 0 stands for `rows.count`.
template <int fixed_rows, int pixels>
HWY_INLINE void add_window(const Spread& spread, float distance, const RowWindow& rows, std::ptrdiff_t stride,
                           float* to) {
  const Floats d;
  constexpr int vectors = pixels * LightBand::channels / lanes;
  Vec light[vectors];
  light_row<pixels>(spread, distance, light);
  const int end = fixed_rows > 0 ? fixed_rows : rows.count;
  HWY_UNROLL(8)
  for (int row = 0; row < end; ++row, to += stride) {
    const Vec share = hn::Set(d, rows.weights[row]);
    for (int i = 0; i < vectors; ++i)
      hn::Store(hn::MulAdd(share, light[i], hn::Load(d, to + i * lanes)), d, to + i * lanes);
  }
}

HWY_INLINE void find_rows(const Splat& splat, const Spread& spread, int top, int band_rows, RowWindow& rows) {
  const float y = splat.y - static_cast<float>(top) - 0.5f;
  const int first = rounded_up(y - spread.reach);
  const int end = static_cast<int>(y + spread.reach + 1);
  rows.count = spread.reach < 2   ? 4
               : spread.reach < 3 ? 6
               : spread.reach < 4 ? 8
                                  : std::min(end, band_rows) - std::max(first, 0);
  rows.first = std::min(std::max(first, 0), band_rows - rows.count);
  weigh(static_cast<float>(rows.first) - y, spread, rows.count, rows.weights);
}

/// Adds a splat, its centre in column `x` of the band.
HWY_INLINE void add(const Spread& spread, const RowWindow& rows, float x, LightBand& band) {
  const int first = rounded_up(x - spread.reach - 0.5f) & ~3;  // of a cache line
  float* const to = band.row(rows.first) + first * LightBand::channels;
  const float distance = static_cast<float>(first) + 0.5f - x;
  const std::ptrdiff_t stride = band.stride();
  if (spread.reach < 2) return add_window<4, 8>(spread, distance, rows, stride, to);
  if (spread.reach < 3) return add_window<6, 12>(spread, distance, rows, stride, to);
  if (spread.reach < 4) return add_window<8, 12>(spread, distance, rows, stride, to);
  const int columns = static_cast<int>(x + spread.reach + 0.5f) - first;
  for (int column = 0; column < columns; column += 16)
    add_window<0, 16>(spread, distance + static_cast<float>(column), rows, stride, to + column * LightBand::channels);
}

void deposit_splats(std::span<const Splat> splats, int top, LightBand& band) {
  RowWindow rows;
  Spread spread;
  const auto left = static_cast<float>(band.left());
  for (const Splat& splat : splats) {
    unpack(splat, spread);
    find_rows(splat, spread, top, band.rows(), rows);
    add(spread, rows, splat.x - left, band);
  }
}

}  // namespace wheatstone::baseline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone::baseline {

HWY_EXPORT(deposit_splats);

void deposit(std::span<const Splat> splats, int top, LightBand& band) {
  if (splats.empty()) return;
  band.note_light();
  HWY_DYNAMIC_DISPATCH(deposit_splats)(splats, top, band);
}

}  // namespace wheatstone::baseline
#endif  // HWY_ONCE
