#include "wheatstone/strokes/seed_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/strokes/squared_errors_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void errors_of_row(const ReferencePicture& reference, const CanvasRows& rows, const RowPart& part, float* errors) {
  const hn::CappedTag<float, Canvas::widest_vector> f;
  const hn::Rebind<std::uint8_t, decltype(f)> bytes;
  const hn::Rebind<std::int32_t, decltype(f)> ints;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const int row = part.row, painted_row = part.row - rows.top;
  const Canvas& canvas = rows.canvas;
  const std::uint8_t* wanted[] = {reference.red.row(row).data(), reference.green.row(row).data(),
                                  reference.blue.row(row).data()};
  const float* painted[] = {canvas.red.row(painted_row).data(), canvas.green.row(painted_row).data(),
                            canvas.blue.row(painted_row).data()};
  const float* coverage = canvas.coverage.row(painted_row).data();
  const auto half = hn::Set(f, 0.5f), bare = hn::Set(f, bare_error);
  int x = part.begin;
  for (; x + lanes <= part.end; x += lanes) {
    auto error = hn::Zero(f);
    for (int channel = 0; channel < 3; ++channel) {
      const auto want = hn::ConvertTo(f, hn::PromoteTo(ints, hn::LoadU(bytes, wanted[channel] + x)));
      const auto difference = hn::Sub(want, hn::LoadU(f, painted[channel] + x));
      error = hn::MulAdd(difference, difference, error);
    }
    const auto is_bare = hn::Lt(hn::LoadU(f, coverage + x), half);
    hn::StoreU(hn::IfThenElse(is_bare, bare, error), f, errors + x);
  }
  for (; x < part.end; ++x) {
    float error = 0;
    for (int channel = 0; channel < 3; ++channel) {
      const float difference = static_cast<float>(wanted[channel][x]) - painted[channel][x];
      error += difference * difference;
    }
    errors[x] = coverage[x] < 0.5f ? bare_error : error;
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(errors_of_row);

void squared_errors(const ReferencePicture& reference, const CanvasRows& rows, const RowPart& part, float* errors) {
  HWY_DYNAMIC_DISPATCH(errors_of_row)(reference, rows, part, errors);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
