#include "wheatstone/display/lenticular_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/display/lenticular_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void views_of_phases_part(const Phases& phases, std::uint32_t views, std::uint16_t* shown, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) shown[i] = view_at(phases.first + i * phases.a_subpixel, views);
}
#else
void views_of_phases_part(const Phases& phases, std::uint32_t views, std::uint16_t* shown, std::size_t count) {
  const hn::CappedTag<std::uint64_t, 8> d64;
  const hn::Repartition<std::uint32_t, decltype(d64)> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const hn::Rebind<std::uint16_t, decltype(d32)> d16;
  const std::size_t lanes = hn::Lanes(d32);
  const auto a_subpixel = hn::Set(d64, phases.a_subpixel);
  const auto a_step = hn::Set(d64, phases.a_subpixel * lanes);
  const auto all_views = hn::Set(d32, views);
  const auto upper = hn::Set(d64, 0xFFFFFFFF00000000u);

  // Even sub-pixels; the odd ones are one further.
  HWY_ALIGN std::uint64_t begin[8];
  for (std::size_t i = 0; i < lanes / 2; ++i) begin[i] = phases.first + 2 * i * phases.a_subpixel;
  auto even = hn::Load(d64, begin);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto odd = hn::Add(even, a_subpixel);
    const auto even_product = hn::MulEven(hn::BitCast(d32, hn::ShiftRight<32>(even)), all_views);
    const auto odd_product = hn::MulEven(hn::BitCast(d32, hn::ShiftRight<32>(odd)), all_views);
    // The products' upper halves, the even ones' moved down, are the views in order.
    const auto both = hn::Or(hn::ShiftRight<32>(even_product), hn::And(odd_product, upper));
    hn::StoreU(hn::DemoteTo(d16, hn::BitCast(di32, both)), d16, shown + i);
    even = hn::Add(even, a_step);
  }
  for (; i < count; ++i) shown[i] = view_at(phases.first + i * phases.a_subpixel, views);
}
#endif

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(views_of_phases_part);

void views_of_phases(const Phases& phases, std::uint32_t views, std::span<std::uint16_t> shown) {
  HWY_DYNAMIC_DISPATCH(views_of_phases_part)(phases, views, shown.data(), shown.size());
}

}  // namespace wheatstone
#endif  // HWY_ONCE
