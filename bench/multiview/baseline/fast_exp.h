// Exponentials and logarithms of base two, good to a few parts in 100 000: a splat's rim and a sigmoid need no more.
// Included once for each processor, by the files that are compiled for every one.

#if defined(WHEATSTONE_BASELINE_FAST_EXP_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef WHEATSTONE_BASELINE_FAST_EXP_H_
#undef WHEATSTONE_BASELINE_FAST_EXP_H_
#else
#define WHEATSTONE_BASELINE_FAST_EXP_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::baseline::HWY_NAMESPACE {

/// 2^x, for x from −126 to 127; beyond, as there.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V fast_exp2(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  x = hn::Clamp(x, hn::Set(d, -126.f), hn::Set(d, 127.f));
  const V whole = hn::Floor(x);
  const V rest = hn::Sub(x, whole);
  // Minimax over [0, 1) of 2^x, with its ends exact.
  V power = hn::MulAdd(rest, hn::Set(d, 1.3697664e-2f), hn::Set(d, 5.1690184e-2f));
  power = hn::MulAdd(power, rest, hn::Set(d, 2.4163845e-1f));
  power = hn::MulAdd(power, rest, hn::Set(d, 6.9297491e-1f));
  power = hn::MulAdd(power, rest, hn::Set(d, 1.f));
  const auto exponent = hn::ShiftLeft<23>(hn::ConvertTo(di, whole));
  return hn::BitCast(d, hn::Add(hn::BitCast(di, power), exponent));
}

/// log2(x), for x > 0; a large negative number for what is not above 0.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V fast_log2(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  x = hn::Max(x, hn::Set(d, 1.17549435e-38f));
  const auto bits = hn::BitCast(di, x);
  const V exponent = hn::ConvertTo(d, hn::Sub(hn::ShiftRight<23>(bits), hn::Set(di, 127)));
  const V mantissa = hn::BitCast(d, hn::Or(hn::And(bits, hn::Set(di, 0x7FFFFF)), hn::Set(di, 0x3F800000)));
  // log2(m) = 2/ln 2 · atanh((m − 1)/(m + 1)), whose series converges fast: the argument is at most 1/3.
  const V one = hn::Set(d, 1.f);
  const V ratio = hn::Div(hn::Sub(mantissa, one), hn::Add(mantissa, one));
  const V square = hn::Mul(ratio, ratio);
  V sum = hn::MulAdd(square, hn::Set(d, 0.41219859f), hn::Set(d, 0.57707802f));
  sum = hn::MulAdd(sum, square, hn::Set(d, 0.96179669f));
  sum = hn::MulAdd(sum, square, hn::Set(d, 2.88539008f));
  return hn::MulAdd(ratio, sum, exponent);
}

}  // namespace wheatstone::baseline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // WHEATSTONE_BASELINE_FAST_EXP_H_
