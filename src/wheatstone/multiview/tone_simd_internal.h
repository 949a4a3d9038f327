// A block of a row of pixels, from sums of light to where they go: a picture's bytes, or light. Included once for each
// processor, by composite_simd.cpp.

#if defined(WHEATSTONE_TONE_SIMD_INTERNAL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef WHEATSTONE_TONE_SIMD_INTERNAL_H_
#undef WHEATSTONE_TONE_SIMD_INTERNAL_H_
#else
#define WHEATSTONE_TONE_SIMD_INTERNAL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "wheatstone/multiview/slice_band_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Vec = hn::Vec<Floats>;
constexpr std::ptrdiff_t lanes = hn::MaxLanes(Floats());

// Columns composited at a time: their light of all planes fits in a first-level cache, and their sums in registers.
constexpr int block_width = 4 * 16;
constexpr int vectors = block_width / lanes;

/// The sums of a block of pixels, channel by channel.
using Sums = float[3][block_width];
using Bytes = std::uint8_t[3][block_width];

HWY_INLINE void store_bytes(hn::Vec<hn::RebindToSigned<Floats>> values, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, Floats> bytes;
  hn::StoreU(hn::DemoteTo(bytes, values), bytes, to);
}

/// sRGB bytes of linear light 0..1.
HWY_INLINE void store_srgb(Vec linear, const ToneMap& map, std::uint8_t* to) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const auto entry = hn::NearestInt(hn::Mul(linear, hn::Set(d, ToneMap::table_size - 1.f)));
  store_bytes(hn::GatherIndex(di, map.table.data(), entry), to);
}

HWY_INLINE void tone_light(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  const Floats d;
  for (int channel = 0; channel < 3; ++channel)
    for (int i = 0; i < block_width; i += lanes) {
      const Vec light = hn::Load(d, sums[channel] + i);
      const Vec exposed = hn::Max(hn::Mul(light, hn::Set(d, map.exposure)), hn::Zero(d));
      const Vec one = hn::Set(d, 1.f);
      const Vec shown = map.bounded ? hn::Min(exposed, one) : hn::Div(exposed, hn::Add(exposed, one));
      store_srgb(shown, map, bytes[channel] + i);
    }
}

/// Where the stretch of a number stands in its table.
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> stretch_index(Vec value, const ToneMap& map) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec share = hn::Max(hn::MulAdd(value, hn::Set(d, map.scale), hn::Set(d, map.offset)), hn::Zero(d));
  const auto index =
      hn::Sub(hn::ShiftRight<ToneMap::index_shift>(hn::BitCast(di, share)), hn::Set(di, ToneMap::first_index));
  return hn::Min(hn::Max(index, hn::Zero(di)), hn::Set(di, ToneMap::stretch_size - 1));
}

HWY_INLINE void tone_mass(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vec nothing = hn::Set(d, 1e-30f);
  const Vec most_hue = hn::Set(d, static_cast<float>(map.hues - 1));
  for (int i = 0; i < block_width; i += lanes) {
    const Vec column = hn::Load(d, sums[0] + i);
    const Vec mean = hn::Div(hn::Load(d, sums[1] + i), hn::Max(column, nothing));
    const auto brightness =
        hn::GatherIndex(di, map.stretch.data(), stretch_index(map.shown == Shown::mean ? mean : column, map));
    const auto hue = hn::NearestInt(hn::Clamp(hn::Mul(mean, most_hue), hn::Zero(d), most_hue));
    const auto found = hn::GatherIndex(di, map.colours.data(), hn::Add(brightness, hue));
    const auto colour = hn::IfThenElseZero(hn::RebindMask(di, hn::Gt(column, nothing)), found);
    const auto low = hn::Set(di, 255);
    store_bytes(hn::And(colour, low), bytes[0] + i);
    store_bytes(hn::And(hn::ShiftRight<8>(colour), low), bytes[1] + i);
    store_bytes(hn::ShiftRight<16>(colour), bytes[2] + i);
  }
}

HWY_INLINE void tone_colours(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  const Floats d;
  for (int i = 0; i < block_width; i += lanes) {
    const Vec most = hn::Max(hn::Max(hn::Load(d, sums[0] + i), hn::Load(d, sums[1] + i)), hn::Load(d, sums[2] + i));
    const Vec bright = hn::GatherIndex(d, map.linear_stretch.data(), stretch_index(most, map));
    const Vec factor = hn::Div(bright, hn::Max(most, hn::Set(d, 1e-30f)));
    for (int channel = 0; channel < 3; ++channel) {
      const Vec light = hn::Mul(hn::Load(d, sums[channel] + i), factor);
      store_srgb(hn::Clamp(light, hn::Zero(d), hn::Set(d, 1.f)), map, bytes[channel] + i);
    }
  }
}

HWY_INLINE void tone(const Sums& sums, const ToneMap& map, Bytes& bytes) {
  if (map.look == Look::thesis) return tone_light(sums, map, bytes);
  if (map.shown == Shown::colours) return tone_colours(sums, map, bytes);
  tone_mass(sums, map, bytes);
}

/// Adds what the picture of half the size has in a block of a row: it is interpolated between its pixels, which keeps
/// the sum. Pixel i of a picture lies between pixels (i − pad) / 2 + 1 and + 3 of the smaller one, whose pad is 2.
HWY_INLINE void add_smaller(const ViewTarget& target, int row, int x, int channels, Sums& sums) {
  const Floats d;
  const int y = row - target.pad;
  const int half_row = (y - (y & 1)) / 2;
  const int near_row = half_row + 2;
  const int far_row = (y & 1) != 0 ? half_row + 3 : half_row + 1;
  const int first = (x - target.pad) / 2 + 1;
  const Vec near_share = hn::Set(d, 0.75f);
  const Vec far_share = hn::Set(d, 0.25f);
  HWY_ALIGN float blend[block_width / 2 + 2 * 16];
  for (int channel = 0; channel < channels; ++channel) {
    const float* const near = target.smaller->row(near_row, channel) + first;
    const float* const far = target.smaller->row(far_row, channel) + first;
    for (int i = 0; i < block_width / 2 + 2; i += lanes)
      hn::Store(hn::MulAdd(near_share, hn::LoadU(d, near + i), hn::Mul(far_share, hn::LoadU(d, far + i))), d,
                blend + i);
    HWY_ALIGN float wide[2 * 16];
    for (int i = 0; i < block_width / 2; i += lanes) {
      const Vec middle = hn::Mul(near_share, hn::LoadU(d, blend + i + 1));
      const Vec even = hn::MulAdd(far_share, hn::LoadU(d, blend + i), middle);
      const Vec odd = hn::MulAdd(far_share, hn::LoadU(d, blend + i + 2), middle);
      hn::StoreInterleaved2(even, odd, d, wide);
      for (int k = 0; k < 2; ++k) {
        float* const to = sums[channel] + 2 * i + k * lanes;
        hn::Store(hn::Add(hn::Load(d, to), hn::Load(d, wide + k * lanes)), d, to);
      }
    }
  }
}

/// Three rows of bytes into pixels.
HWY_INLINE void interleave(const std::uint8_t* red, const std::uint8_t* green, const std::uint8_t* blue, int count,
                           Rgb8* to) {
  const hn::CappedTag<std::uint8_t, 16> d;
  const int step = hn::MaxLanes(d);
  int x = 0;
  for (; x + step <= count; x += step)
    hn::StoreInterleaved3(hn::LoadU(d, red + x), hn::LoadU(d, green + x), hn::LoadU(d, blue + x), d,
                          reinterpret_cast<std::uint8_t*>(to + x));
  for (; x < count; ++x) to[x] = {red[x], green[x], blue[x]};
}

/// A block of one view's sums goes where it belongs.
HWY_INLINE void finish_block(Sums& sums, const ToneMap& map, const ViewTarget& target, int row, int x) {
  const Floats d;
  const int channels = map.three_channels() ? 3 : 2;
  if (target.smaller != nullptr) add_smaller(target, row, x, channels, sums);
  if (target.light != nullptr) {
    for (int channel = 0; channel < target.light->channels(); ++channel)
      for (int i = 0; i < block_width; i += lanes)
        hn::StoreU(hn::Load(d, sums[channel] + i), d, target.light->row(row, channel) + x + i);
    return;
  }
  HWY_ALIGN Bytes bytes;
  tone(sums, map, bytes);
  interleave(bytes[0], bytes[1], bytes[2], std::min(block_width, target.picture.width() - x),
             target.picture.row(row).data() + x);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // WHEATSTONE_TONE_SIMD_INTERNAL_H_
