// Depth planes of a block of a row of pixels, unpacked, and read between their pixels. Included once for each
// processor, by composite_simd.cpp.

#if defined(WHEATSTONE_READ_PLANES_SIMD_INTERNAL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef WHEATSTONE_READ_PLANES_SIMD_INTERNAL_H_
#undef WHEATSTONE_READ_PLANES_SIMD_INTERNAL_H_
#else
#define WHEATSTONE_READ_PLANES_SIMD_INTERNAL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/multiview/tone_simd_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// How far a plane moves in a view: whole pixels, and the weights of the pixels around the rest.
struct Shift {
  int whole;
  std::array<float, 4> weight;
};

Shift shift_of(float pixels, SliceFilter filter) {
  Shift shift{};
  if (filter == SliceFilter::nearest) {
    shift.whole = static_cast<int>(std::floor(pixels + 0.5f));
    shift.weight[0] = 1;
    return shift;
  }
  const float whole = std::floor(pixels);
  const float f = pixels - whole;
  shift.whole = static_cast<int>(whole);
  if (filter == SliceFilter::linear) {
    shift.weight = {1 - f, f, 0, 0};
    return shift;
  }
  // Keys 1981, a = −1/2.
  shift.whole -= 1;
  shift.weight = {((-0.5f * f + 1) * f - 0.5f) * f, (1.5f * f - 2.5f) * f * f + 1, ((-1.5f * f + 2) * f + 0.5f) * f,
                  (0.5f * f - 0.5f) * f * f};
  return shift;
}

/// One block of one row of all planes, as floats.
struct UnpackedBlock {
  static constexpr int beside = 2 * 16;  // what a vector may reach beyond the first and the last
  UnpackedBlock(int planes, int channels_, int widest_)
      : channels(channels_),
        widest(widest_),
        values(static_cast<std::size_t>(planes) * channels * widest + 2 * beside),
        first(static_cast<std::size_t>(planes)) {}
  int channels, widest;
  std::vector<float> values;  // [plane][channel][widest]
  std::vector<int> first;     // column of each plane's value 0
  std::vector<int> lit;       // the planes that hold light here
  const float* at(int plane, int channel) const {
    return values.data() + beside + (static_cast<std::size_t>(plane) * channels + channel) * widest;
  }
  float* at(int plane, int channel) { return const_cast<float*>(std::as_const(*this).at(plane, channel)); }
};

/// Unpacks the planes that are lit where any view of the group looks, and lists them.
void unpack(const SliceBand& slices, int row, int x, const std::vector<std::array<int, 2>>& reach,
            UnpackedBlock& block) {
  const Floats d;
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  block.lit.clear();
  for (int plane = 0; plane < slices.planes(); ++plane) {
    const int first = std::max(x + reach[plane][0], slices.left() - slices.margin());
    const int end = std::min(x + block_width + reach[plane][1], slices.right() + slices.margin());
    // Dark planes cost nothing.
    if (!slices.lit(plane, row, first - slices.left(), end - slices.left())) continue;
    block.lit.push_back(plane);
    block.first[plane] = x + reach[plane][0];
    for (int channel = 0; channel < block.channels; ++channel) {
      const std::uint16_t* from = slices.row(plane, row, channel) + (first - slices.left());
      float* to = block.at(plane, channel) + (first - block.first[plane]);
      for (int i = 0; i < end - first; i += lanes)
        hn::StoreU(hn::PromoteTo(d, hn::BitCast(halves, hn::LoadU(bits, from + i))), d, to + i);
    }
  }
}

/// The factors by which the pixels of a block move farther than elsewhere.
struct Gains {
  bool all_one = true;
  HWY_ALIGN float values[block_width];
};

void find_gains(const std::optional<Focus>& focus, int x, int y, Gains& gains) {
  gains.all_one = true;
  std::fill_n(gains.values, block_width, 1.f);
  if (!focus || std::abs(static_cast<float>(y) + 0.5f - focus->y_px) >= focus->radius_px) return;
  const float from_middle = static_cast<float>(x) + block_width / 2.f - focus->x_px;
  if (std::abs(from_middle) >= focus->radius_px + block_width / 2.f) return;
  for (int i = 0; i < block_width; ++i) {
    gains.values[i] = focus->gain_at(static_cast<float>(x + i) + 0.5f, static_cast<float>(y) + 0.5f);
    gains.all_one = gains.all_one && gains.values[i] == 1;
  }
}

/// The weights of the pixels around a place between them, and the first of these.
template <int taps>
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> weigh_around(Vec place, Vec share, Vec (&weights)[taps]) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec one = hn::Set(d, 1.f);
  if constexpr (taps == 1) {
    weights[0] = share;
    return hn::ConvertTo(di, hn::Floor(hn::Add(place, hn::Set(d, 0.5f))));
  }
  const Vec whole = hn::Floor(place);
  const Vec f = hn::Sub(place, whole);
  if constexpr (taps == 2) {
    weights[1] = hn::Mul(f, share);
    weights[0] = hn::Sub(share, weights[1]);
  } else if constexpr (taps == 4) {
    const auto polynomial = [&](float cubic, float square, float linear, Vec constant) {
      const Vec inner = hn::MulAdd(hn::Set(d, cubic), f, hn::Set(d, square));
      return hn::Mul(hn::MulAdd(hn::MulAdd(inner, f, hn::Set(d, linear)), f, constant), share);
    };
    weights[0] = polynomial(-0.5f, 1, -0.5f, hn::Zero(d));
    weights[1] = polynomial(1.5f, -2.5f, 0, one);
    weights[2] = polynomial(-1.5f, 2, 0.5f, hn::Zero(d));
    weights[3] = polynomial(0.5f, -0.5f, 0, hn::Zero(d));
  }
  return hn::ConvertTo(di, taps == 4 ? hn::Sub(whole, one) : whole);
}

/// Reads a plane of a block around places of its own for each pixel: adds what it finds to `sum`, channel by channel.
template <int taps>
HWY_INLINE void read_around(const UnpackedBlock& block, int plane, Vec place, Vec share, Vec* sum) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  Vec weights[taps];
  const auto wanted = weigh_around<taps>(place, share, weights);
  const auto first = hn::Min(hn::Max(wanted, hn::Zero(di)), hn::Set(di, block.widest - taps));
  const auto shift = hn::Sub(first, hn::Iota(di, 0));
  const int least = hn::GetLane(hn::MinOfLanes(di, shift));
  const int most = hn::GetLane(hn::MaxOfLanes(di, shift));
  constexpr int far_apart = 8;
  if (most - least > far_apart) {
    for (int tap = 0; tap < taps; ++tap)
      for (int channel = 0; channel < block.channels; ++channel)
        sum[channel] = hn::MulAdd(
            weights[tap], hn::GatherIndex(d, block.at(plane, channel), hn::Add(first, hn::Set(di, tap))), sum[channel]);
    return;
  }
  // Pixels that move by nearly the same amount: a pixel that only some of them need is read for all, with a weight of 0
  // for the others.
  for (int at = least; at < most + taps; ++at) {
    Vec weight = weights[at - least < taps ? at - least : 0];
    if (least != most) {
      weight = hn::Zero(d);
      for (int tap = 0; tap < taps; ++tap) {
        const auto here = hn::RebindMask(d, hn::Eq(shift, hn::Set(di, at - tap)));
        weight = hn::IfThenElse(here, weights[tap], weight);
      }
    }
    for (int channel = 0; channel < block.channels; ++channel)
      sum[channel] = hn::MulAdd(weight, hn::LoadU(d, block.at(plane, channel) + at), sum[channel]);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // WHEATSTONE_READ_PLANES_SIMD_INTERNAL_H_
