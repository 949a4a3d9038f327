// Splats of mass: the kernel along both axes of some splats at a time, and their light. Included once for each
// processor, by deposit_simd.cpp.

#if defined(WHEATSTONE_MASS_SPLATS_INTERNAL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef WHEATSTONE_MASS_SPLATS_INTERNAL_H_
#undef WHEATSTONE_MASS_SPLATS_INTERNAL_H_
#else
#define WHEATSTONE_MASS_SPLATS_INTERNAL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <span>

#include "wheatstone/multiview/light_band_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector is a few pixels of four channels: up to four.
using Floats = hn::CappedTag<float, 16>;
using Vec = hn::Vec<Floats>;
constexpr std::ptrdiff_t lanes = hn::MaxLanes(Floats());
constexpr int most_rows = 48;
// Pixels along an axis of a splat that is made ready, and one more.
constexpr int most_parts = 16;

HWY_INLINE int rounded_up(float x) {
  const int whole = static_cast<int>(x);
  return whole + (static_cast<float>(whole) < x);
}

/// How much of a Gaussian lies between its middle and a distance, −½ to ½; all of a half beyond its rim, which is 1.
/// There, 2.75 deviations from the middle, the error function is 0.99404: the polynomial is ½ erf(2.75 x/√2) over that,
/// right to 2e-6.
HWY_INLINE Vec half_within_gaussian(Vec scaled) {
  const Floats d;
  const Vec x = hn::Max(hn::Min(scaled, hn::Set(d, 1.f)), hn::Set(d, -1.f));
  const Vec square = hn::Mul(x, x);
  Vec half = hn::MulAdd(square, hn::Set(d, 0.0665206686f), hn::Set(d, -0.347017288f));
  half = hn::MulAdd(half, square, hn::Set(d, 0.852566719f));
  half = hn::MulAdd(half, square, hn::Set(d, -1.35004795f));
  half = hn::MulAdd(half, square, hn::Set(d, 1.56421399f));
  half = hn::MulAdd(half, square, hn::Set(d, -1.38987398f));
  half = hn::MulAdd(half, square, hn::Set(d, 1.10363781f));
  return hn::Mul(half, x);
}

/// The same of the cubic spline kernel, projected on an axis, where 1 is its radius: the integrals of 32 (1−r)³ r and
/// of 16 r (1 − 6 r² + 6 r³) beyond and below a half, from the distance on.
HWY_INLINE Vec half_within_spline(Vec scaled) {
  const Floats d;
  const Vec x = hn::Min(hn::Abs(scaled), hn::Set(d, 1.f));
  const Vec square = hn::Mul(x, x);
  Vec inner = hn::MulAdd(x, hn::Set(d, -3.2f), hn::Set(d, 4.8f));
  inner = hn::MulAdd(inner, square, hn::Set(d, -8.f / 3));
  inner = hn::Mul(hn::MulAdd(inner, square, hn::Set(d, 1.4f)), x);
  const Vec rest = hn::Sub(hn::Set(d, 1.f), x);
  const Vec fourth = hn::Mul(hn::Mul(rest, rest), hn::Mul(rest, rest));
  const Vec tail = hn::Mul(hn::MulAdd(rest, hn::Set(d, -16.f / 15), hn::Set(d, 1.6f)), hn::Mul(fourth, rest));
  const Vec outer = hn::Sub(hn::Set(d, 0.5f), tail);
  return hn::CopySign(hn::IfThenElse(hn::Lt(x, hn::Set(d, 0.5f)), inner, outer), scaled);
}

HWY_INLINE Vec half_within(Vec scaled, bool spline) {
  return spline ? half_within_spline(scaled) : half_within_gaussian(scaled);
}

/// The shares of a splat of mass that lie over consecutive pixels; `first_edge` is the distance of the first pixel's
/// edge from the splat's middle. The last lane holds 0.
HWY_INLINE Vec parts_from(float first_edge, float scale, bool spline) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec edges = hn::Mul(hn::Iota(d, first_edge), hn::Set(d, scale));
  const Vec at_edge = half_within(edges, spline);
  const auto next = hn::IndicesFromVec(d, hn::Min(hn::Iota(di, 1), hn::Set(di, static_cast<int>(lanes) - 1)));
  return hn::Sub(hn::TableLookupLanes(at_edge, next), at_edge);
}

/// The same for `count` pixels or more.
HWY_INLINE void find_parts(float first_edge, float scale, bool spline, int count, float* parts) {
  const Floats d;
  if (count < lanes) return hn::StoreU(parts_from(first_edge, scale, spline), d, parts);
  HWY_ALIGN float at_edge[most_rows + 2 * lanes];
  const int edges = count / static_cast<int>(lanes) * static_cast<int>(lanes) + static_cast<int>(lanes);
  for (int i = 0; i < edges; i += lanes) {
    const Vec distance = hn::Add(hn::Iota(d, static_cast<float>(i)), hn::Set(d, first_edge));
    hn::Store(half_within(hn::Mul(distance, hn::Set(d, scale)), spline), d, at_edge + i);
  }
  hn::Store(half_within(hn::Set(d, 1.f), spline), d, at_edge + edges);
  for (int i = 0; i < edges; i += lanes)
    hn::StoreU(hn::Sub(hn::LoadU(d, at_edge + i + 1), hn::Load(d, at_edge + i)), d, parts + i);
}

/// A cache line holds eight pixels of mass.
constexpr int mass_line = 8;

/// The light of pixels of mass, from `skipped` before the first part on. The last part is 0.
template <int vectors>
HWY_INLINE void light_mass(Vec parts, int skipped, const float* two_channels, Vec (&light)[vectors]) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const auto last = hn::Set(du, static_cast<std::uint32_t>(lanes - 1));
  const auto pixel = hn::Sub(hn::ShiftRight<1>(hn::Iota(du, 0)), hn::Set(du, static_cast<std::uint32_t>(skipped)));
  const Vec colour = hn::LoadDup128(d, two_channels);
  for (int i = 0; i < vectors; ++i) {
    // Numbers below that of the first part wrap around to large ones, which stand for the last part.
    const auto part = hn::Min(hn::Add(pixel, hn::Set(du, static_cast<std::uint32_t>(i * lanes / 2))), last);
    light[i] = hn::Mul(hn::TableLookupLanes(parts, hn::IndicesFromVec(d, part)), colour);
  }
}

/// The same of pixels whose parts are in memory.
template <int vectors>
HWY_INLINE void light_mass_in_memory(const float* parts, const float* two_channels, Vec (&light)[vectors]) {
  const Floats d;
  const auto pixel = hn::IndicesFromVec(d, hn::ShiftRight<1>(hn::Iota(hn::RebindToSigned<Floats>(), 0)));
  for (int i = 0; i < vectors; ++i) {
    const Vec colour = lanes < 4 ? hn::Load(d, two_channels + i * lanes % 4) : hn::LoadDup128(d, two_channels);
    light[i] = hn::Mul(hn::TableLookupLanes(hn::LoadU(d, parts + i * lanes / 2), pixel), colour);
  }
}

/// A batch of mass splats: first their values without the kernel, then the kernel along both axes. They are added when
/// all of this is computed. The number of rows is often mispredicted, and in this way a misprediction does not wait for
/// long computations.
struct MassSplats {
  static constexpr std::size_t most = 32;
  HWY_ALIGN float x[most], y[most], light[most], second[most];
  HWY_ALIGN std::uint16_t size[most], second_share[most];
  HWY_ALIGN float first_edge[most], top_edge[most], scale[most];
  HWY_ALIGN std::int32_t column[most], skipped[most], columns_end[most], row[most], row_count[most], extent[most];
  HWY_ALIGN float columns[most][3 * most_parts];  // of narrow vectors, from `skipped` on
  HWY_ALIGN float rows[most][most_parts];
};

/// Finds the pixels that each splat touches: rows from `row` on, two at a time, moved into the band where they would
/// stick out; columns from `column` on, of which the first `skipped` are another line's.
void find_pixels(std::size_t count, int band_rows, MassSplats& splats) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  const auto promoted = [&](const std::uint16_t* from) {
    return hn::PromoteTo(d, hn::BitCast(halves, hn::Load(bits, from)));
  };
  const Vec half = hn::Set(d, 0.5f);
  const auto rows = hn::Set(di, band_rows);
  const auto one = hn::Set(di, 1);
  for (std::size_t i = 0; i < count; i += lanes) {
    const Vec size = promoted(splats.size + i);
    const Vec x = hn::Load(d, splats.x + i);
    const Vec y = hn::Load(d, splats.y + i);
    // From the middle to the last pixel's farther edge.
    const Vec reach = hn::Add(hn::MulAdd(size, half, half), half);
    const auto touched = hn::ConvertTo(di, hn::Ceil(hn::Sub(x, reach)));
    const auto end = hn::ConvertTo(di, hn::Add(x, reach));
    const auto top = hn::Max(hn::ConvertTo(di, hn::Ceil(hn::Sub(y, reach))), hn::Zero(di));
    const auto bottom = hn::Min(hn::ConvertTo(di, hn::Add(y, reach)), rows);
    const auto row_count = hn::AndNot(one, hn::Add(hn::Sub(bottom, top), one));
    const auto row = hn::Min(top, hn::Sub(rows, row_count));
    const auto column = hn::AndNot(hn::Set(di, mass_line - 1), touched);
    hn::Store(hn::Max(hn::Sub(end, touched), row_count), di, splats.extent + i);
    hn::Store(row, di, splats.row + i);
    hn::Store(row_count, di, splats.row_count + i);
    hn::Store(column, di, splats.column + i);
    hn::Store(hn::Sub(touched, column), di, splats.skipped + i);
    hn::Store(hn::Sub(end, column), di, splats.columns_end + i);
    hn::Store(hn::Sub(hn::ConvertTo(d, touched), x), d, splats.first_edge + i);
    hn::Store(hn::Sub(hn::ConvertTo(d, row), y), d, splats.top_edge + i);
    hn::Store(hn::Div(hn::Set(d, 2.f), size), d, splats.scale + i);
    hn::Store(hn::Mul(hn::Load(d, splats.light + i), promoted(splats.second_share + i)), d, splats.second + i);
  }
}

/// Makes splats ready that touch fewer than `most_parts` pixels along either axis.
void make_ready(std::span<const Splat> from, int top, bool spline, const LightBand& band, MassSplats& splats) {
  const auto left = static_cast<float>(band.left());
  const auto upper = static_cast<float>(top);
  for (std::size_t i = 0; i < from.size(); ++i) {
    splats.x[i] = from[i].x - left;
    splats.y[i] = from[i].y - upper;
    std::memcpy(splats.light + i, from[i].colour, sizeof(float));
    splats.second_share[i] = from[i].colour[2];
    splats.size[i] = from[i].size;
  }
  find_pixels(from.size(), band.rows(), splats);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (splats.extent[i] >= most_parts) continue;
    find_parts(splats.top_edge[i], splats.scale[i], spline, most_parts - 1, splats.rows[i]);
    int skipped = 0;
    if constexpr (lanes != most_parts) {
      skipped = splats.skipped[i];
      std::fill_n(splats.columns[i], std::size(splats.columns[i]), 0.f);
    }
    find_parts(splats.first_edge[i], splats.scale[i], spline, most_parts - 1, splats.columns[i] + skipped);
  }
}

template <int vectors>
HWY_INLINE void add_row_pairs(const Vec (&light)[vectors], const float* rows, int count, std::ptrdiff_t stride,
                              float* to) {
  const Floats d;
  for (int row = 0; row < count; row += 2, to += 2 * stride) {
    const Vec upper = hn::Set(d, rows[row]);
    const Vec lower = hn::Set(d, rows[row + 1]);
    for (int i = 0; i < vectors; ++i) {
      float* const next = to + stride + i * lanes;
      hn::Store(hn::MulAdd(upper, light[i], hn::Load(d, to + i * lanes)), d, to + i * lanes);
      hn::Store(hn::MulAdd(lower, light[i], hn::Load(d, next)), d, next);
    }
  }
}

/// Adds the lines of pixels from number `line` on of splat i.
template <int lines>
HWY_INLINE void add_lines(const MassSplats& splats, std::size_t i, int line, LightBand& band) {
  const Floats d;
  HWY_ALIGN const float colour[4] = {splats.light[i], splats.second[i], splats.light[i], splats.second[i]};
  Vec light[lines * 16 / lanes];
  if constexpr (lanes == most_parts) {
    light_mass(hn::Load(d, splats.columns[i]), splats.skipped[i] - line * mass_line, colour, light);
  } else {
    light_mass_in_memory(splats.columns[i] + line * mass_line, colour, light);
  }
  float* const to = band.row(splats.row[i]) + (splats.column[i] + line * mass_line) * channels_in(Deposit::mass);
  add_row_pairs(light, splats.rows[i], splats.row_count[i], band.stride(), to);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // WHEATSTONE_MASS_SPLATS_INTERNAL_H_
