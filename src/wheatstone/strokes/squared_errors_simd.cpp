#include <algorithm>
#include <array>

#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/strokes/seed_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/strokes/squared_errors_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void errors_of_row(const ReferencePicture& reference, const Canvas& canvas, const RowPart& part, float* errors) {
  const hn::CappedTag<float, Canvas::widest_vector> f;
  const hn::Rebind<std::uint8_t, decltype(f)> bytes;
  const hn::Rebind<std::int32_t, decltype(f)> ints;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const int row = part.row;
  const std::uint8_t* wanted[] = {reference.red.row(row).data(), reference.green.row(row).data(),
                                  reference.blue.row(row).data()};
  const float* painted[] = {canvas.red.row(row).data(), canvas.green.row(row).data(), canvas.blue.row(row).data()};
  const float* coverage = canvas.coverage.row(row).data();
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

/// The next columns of a row, from `x` on; `photograph` are their colours.
HWY_INLINE void mark_columns(const Rgb8* photograph, const Canvas& canvas, int row, int x, std::uint8_t* unlike) {
  const hn::CappedTag<float, Canvas::widest_vector> f;
  const hn::Rebind<std::uint8_t, decltype(f)> bytes;
  const hn::Rebind<std::int32_t, decltype(f)> ints;
  auto red = hn::Zero(bytes), green = red, blue = red;
  hn::LoadInterleaved3(bytes, &photograph->r, red, green, blue);
  const auto squared_difference = [&](auto wanted, const Image<float>& plane) {
    const auto level = hn::ConvertTo(ints, hn::Add(hn::LoadU(f, plane.row(row).data() + x), hn::Set(f, 0.5f)));
    const auto difference = hn::Sub(hn::PromoteTo(ints, wanted), level);
    return hn::Mul(difference, difference);
  };
  const auto squared = hn::Add(hn::Add(squared_difference(red, canvas.red), squared_difference(green, canvas.green)),
                               squared_difference(blue, canvas.blue));
  constexpr int most = static_cast<int>(unlike_colours);
  const auto is_unlike = hn::Gt(squared, hn::Set(ints, most * most));
  hn::StoreU(hn::DemoteTo(bytes, hn::IfThenElseZero(is_unlike, hn::Set(ints, 255))), bytes, unlike);
}

void mark_unlike_of_row(ImageView<const Rgb8> photograph, const Canvas& canvas, int row,
                        std::span<std::uint8_t> unlike) {
  constexpr int widest = Canvas::widest_vector;
  const int lanes = static_cast<int>(hn::Lanes(hn::CappedTag<float, widest>()));
  const Rgb8* const from = photograph.row(row).data();
  const int width = static_cast<int>(unlike.size());
  int x = 0;
  for (; x + lanes <= width; x += lanes) mark_columns(from + x, canvas, row, x, unlike.data() + x);
  std::array<Rgb8, widest> last{};
  std::array<std::uint8_t, widest> unlike_last{};
  std::copy(from + x, from + width, last.begin());
  mark_columns(last.data(), canvas, row, x, unlike_last.data());  // rows of the canvas are padded
  std::copy_n(unlike_last.begin(), width - x, unlike.begin() + x);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(errors_of_row);
HWY_EXPORT(mark_unlike_of_row);

void squared_errors(const ReferencePicture& reference, const Canvas& canvas, const RowPart& part, float* errors) {
  HWY_DYNAMIC_DISPATCH(errors_of_row)(reference, canvas, part, errors);
}

void mark_unlike(ImageView<const Rgb8> photograph, const Canvas& canvas, int row, std::span<std::uint8_t> unlike) {
  HWY_DYNAMIC_DISPATCH(mark_unlike_of_row)(photograph, canvas, row, unlike);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
