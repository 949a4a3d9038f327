// What drawing measured strokes and drawing stamps share: vectors of pixels, and the paint that is composited under
// what is drawn. Included by files that are compiled for several processors.

#if defined(WHEATSTONE_DRAWING_STROKE_PAINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef WHEATSTONE_DRAWING_STROKE_PAINT_INL_H_
#undef WHEATSTONE_DRAWING_STROKE_PAINT_INL_H_
#else
#define WHEATSTONE_DRAWING_STROKE_PAINT_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "wheatstone/drawing/bristles_simd_internal.h"
#include "wheatstone/drawing/rasterise_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, Canvas::widest_vector>;

/// A bit for each lane, from the lowest.
HWY_INLINE std::uint32_t bits_of(hn::Mask<Floats> lanes) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Floats(), lanes, bytes);
  if constexpr (std::endian::native == std::endian::little) {  // one instruction, which compilers do not find
    std::uint16_t bits = 0;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
  }
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
}

/// The lanes whose bits are set.
HWY_INLINE hn::Mask<Floats> lanes_of(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(Floats(), bytes);
}

/// The paint of some pixels of a stroke: cover, 0..1, and, if the paint varies, the share of the colour's change and
/// the tone.
struct PaintHere {
  hn::Vec<Floats> cover, share, tone;
};

/// A stroke's colour, which is composited under what is drawn already. `varies`: it varies within the stroke.
template <bool varies>
struct Paint {
  template <class Stroke>
  explicit Paint(const Stroke& stroke)
      : red(hn::Set(Floats(), stroke.red)),
        green(hn::Set(Floats(), stroke.green)),
        blue(hn::Set(Floats(), stroke.blue)),
        red_change(hn::Set(Floats(), stroke.red_change)),
        green_change(hn::Set(Floats(), stroke.green_change)),
        blue_change(hn::Set(Floats(), stroke.blue_change)),
        opacity(hn::Set(Floats(), stroke.opacity)) {}

  /// Part of a block, from its column `i` on, as far as it lets light through. Returns which columns still do.
  HWY_INLINE std::uint32_t slide_under(const PaintHere& here, FrontToBackAccumulator::Block& block, int i) const {
    const Floats f;
    const auto through = hn::Load(f, block.light + i);
    const auto share = hn::Mul(hn::Mul(here.cover, opacity), through);
    const auto add = [&](hn::Vec<Floats> level, hn::Vec<Floats> change, float* drawn) {
      if constexpr (varies) {
        level = hn::Add(hn::MulAdd(change, here.share, level), here.tone);
        level = hn::Min(hn::Max(level, hn::Zero(f)), hn::Set(f, 255.f));
      }
      hn::Store(hn::MulAdd(level, share, hn::Load(f, drawn + i)), f, drawn + i);
    };
    add(red, red_change, block.red);
    add(green, green_change, block.green);
    add(blue, blue_change, block.blue);
    const auto left = hn::Sub(through, share);
    hn::Store(left, f, block.light + i);
    return bits_of(hn::Gt(left, hn::Set(f, FrontToBackAccumulator::dark))) << i;
  }

  hn::Vec<Floats> red, green, blue, red_change, green_change, blue_change, opacity;
};

/// The paint of a row of a band, from column `x` on, once distances and places are measured.
HWY_INLINE Bristles::Paint paint_of_row(const Bristles& bristles, const DistanceBand& band, int row, int x) {
  const Floats f;
  const std::size_t at =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(band.stride) + static_cast<std::size_t>(x);
  return bristles.at({hn::Sqrt(hn::LoadU(f, band.squared.data() + at)), hn::LoadU(f, band.along.data() + at),
                      hn::LoadU(f, band.across.data() + at), hn::LoadU(f, band.facing.data() + at)});
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // WHEATSTONE_DRAWING_STROKE_PAINT_INL_H_
