#include <array>
#include <limits>

#include "wheatstone/stereo/compose_row_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/stereo/compose_row_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t most_lanes = 16;
using Words = hn::CappedTag<std::uint16_t, most_lanes>;
using Bytes = hn::Rebind<std::uint8_t, Words>;
using Floats = hn::CappedTag<float, most_lanes>;

bool is_laid(const LandedRow& landed, std::size_t x, float tolerance_px, std::span<const float> disparity) {
  return landed.nearest[x] != -std::numeric_limits<float>::infinity() &&
         !(disparity[x] + tolerance_px >= landed.nearest[x]);
}

/// Which of some pixels are to be written, and where they come from.
struct Laid {
  bool any = false, side_by_side = true;
  alignas(64) std::array<std::uint8_t, most_lanes> mask;     ///< 255 or 0
  alignas(64) std::array<std::uint16_t, most_lanes> shares;  ///< of the second pixel, of 256
};

HWY_INLINE Laid look_at(const LandedRow& landed, std::size_t x, float tolerance_px, std::span<float> disparity) {
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  Laid laid;
  for (std::size_t i = 0; i < hn::Lanes(Words()); i += hn::Lanes(f)) {
    const auto nearest = hn::LoadU(f, &landed.nearest[x + i]), there = hn::LoadU(f, &disparity[x + i]);
    const auto is_there = hn::Or(hn::Ge(hn::Add(there, hn::Set(f, tolerance_px)), nearest),
                                 hn::Eq(nearest, hn::Set(f, -std::numeric_limits<float>::infinity())));
    hn::StoreU(hn::IfThenElse(is_there, there, nearest), f, &disparity[x + i]);
    laid.any = laid.any || !hn::AllTrue(f, is_there);
    const auto expected =
        hn::Add(hn::Set(integers, landed.from.x[x] + static_cast<std::int32_t>(i)), hn::Iota(integers, 0));
    const auto columns = hn::LoadU(integers, &landed.from.x[x + i]);
    laid.side_by_side = laid.side_by_side && hn::AllTrue(integers, hn::Eq(columns, expected));
    const auto share = hn::ConvertTo(
        integers, hn::Add(hn::Mul(hn::LoadU(f, &landed.from.t[x + i]), hn::Set(f, 256.f)), hn::Set(f, 0.5f)));
    hn::StoreU(hn::DemoteTo(hn::Rebind<std::uint16_t, Floats>(), share), hn::Rebind<std::uint16_t, Floats>(),
               &laid.shares[i]);
    const auto mask = hn::IfThenZeroElse(hn::RebindMask(integers, is_there), hn::Set(integers, 255));
    hn::StoreU(hn::DemoteTo(hn::Rebind<std::uint8_t, Floats>(), mask), hn::Rebind<std::uint8_t, Floats>(),
               &laid.mask[i]);
  }
  return laid;
}

/// For pixels that also lie side by side in the row that they come from.
HWY_INLINE void lay_side_by_side(const Laid& laid, const Rgb8* from, Rgb8* to) {
  const Words words;
  const Bytes bytes;
  const auto share = hn::LoadU(words, laid.shares.data()), rest = hn::Sub(hn::Set(words, 256), share);
  const auto wanted = hn::LoadU(bytes, laid.mask.data());
  std::array<hn::Vec<Bytes>, 3> here, next, before;
  hn::LoadInterleaved3(bytes, &from[0].r, here[0], here[1], here[2]);
  hn::LoadInterleaved3(bytes, &from[1].r, next[0], next[1], next[2]);
  hn::LoadInterleaved3(bytes, &to->r, before[0], before[1], before[2]);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto sum =
        hn::Add(hn::Mul(hn::PromoteTo(words, here[c]), rest), hn::Mul(hn::PromoteTo(words, next[c]), share));
    const auto blended = hn::ShiftRight<8>(hn::Add(sum, hn::Set(words, 128)));
    const auto level = hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<Words>(), blended));
    before[c] = hn::Or(hn::And(wanted, level), hn::AndNot(wanted, before[c]));
  }
  hn::StoreInterleaved3(before[0], before[1], before[2], bytes, &to->r);
}

void compose(const LandedRow& landed, float tolerance_px, std::span<Rgb8> picture, std::span<float> disparity) {
  const auto lay = [&](std::size_t x) {
    const int column = landed.from.x[x];
    const float t = landed.from.t[x];
    picture[x] = t > 0 ? blend(landed.colours[column], landed.colours[column + 1], t) : landed.colours[column];
  };
  const std::size_t lanes = hn::Lanes(Words());
  std::size_t x = 0;
  for (; x + lanes <= picture.size(); x += lanes) {
    const Laid laid = look_at(landed, x, tolerance_px, disparity);
    if (!laid.any) continue;
    const auto first = static_cast<std::size_t>(landed.from.x[x]);
    if (laid.side_by_side && first + lanes < landed.colours.size()) {
      lay_side_by_side(laid, &landed.colours[first], &picture[x]);
    } else {
      for (std::size_t i = 0; i < lanes; ++i)
        if (laid.mask[i] != 0) lay(x + i);
    }
  }
  for (; x < picture.size(); ++x) {
    if (!is_laid(landed, x, tolerance_px, disparity)) continue;
    lay(x);
    disparity[x] = landed.nearest[x];
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(compose);

void compose_row(const LandedRow& landed, float tolerance_px, std::span<Rgb8> picture, std::span<float> disparity) {
  HWY_DYNAMIC_DISPATCH(compose)(landed, tolerance_px, picture, disparity);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
