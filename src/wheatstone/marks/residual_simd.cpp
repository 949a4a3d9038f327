#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <span>

#include "wheatstone/marks/residual.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/marks/residual_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint16_t, 32>;
using Bytes = hn::Rebind<std::uint8_t, Words>;

/// As is_like, of colours that follow each other and as many others.
template <class V>
HWY_INLINE auto are_like(const Rgb8* colours, V red, V green, V blue) {
  const Words words;
  V own_red = red, own_green = green, own_blue = blue;
  hn::LoadInterleaved3(Bytes(), &colours->r, own_red, own_green, own_blue);
  const auto squared = [&](V level, V other) {
    const auto difference = hn::PromoteTo(words, hn::Sub(hn::Max(level, other), hn::Min(level, other)));
    return hn::Mul(difference, difference);  // at most 255 squared, which a word holds
  };
  const auto sum =
      hn::SaturatedAdd(hn::SaturatedAdd(squared(own_red, red), squared(own_green, green)), squared(own_blue, blue));
  return hn::Eq(sum, hn::Min(sum, hn::Set(words, static_cast<std::uint16_t>(unlike_colours * unlike_colours))));
}

/// True where one of columns [begin, end) of a row is like a colour.
bool row_has(std::span<const Rgb8> row, Rgb8 colour, int begin, int end) {
  const Words words;
  const Bytes bytes;
  const int lanes = static_cast<int>(hn::Lanes(words)), width = static_cast<int>(row.size());
  if (width < lanes)
    return std::any_of(row.begin() + begin, row.begin() + end, [&](Rgb8 there) { return is_like(there, colour); });
  const auto red = hn::Set(bytes, colour.r), green = hn::Set(bytes, colour.g), blue = hn::Set(bytes, colour.b);
  for (int x = begin; x < end; x += lanes) {
    const int first = std::min(x, width - lanes);  // a vector ends with the row, or before
    const auto like = are_like(&row[static_cast<std::size_t>(first)], red, green, blue);
    const auto asked_for = hn::AndNot(hn::FirstN(words, static_cast<std::size_t>(x - first)),
                                      hn::FirstN(words, static_cast<std::size_t>(end - first)));
    if (!hn::AllFalse(words, hn::And(like, asked_for))) return true;
  }
  return false;
}

bool disc_has(ImageView<const Rgb8> picture, std::span<const int> half_widths, Rgb8 colour, int x, int y) {
  for (int away = 0; away < static_cast<int>(half_widths.size()); ++away) {
    const int half = half_widths[static_cast<std::size_t>(away)];
    const int begin = std::max(x - half, 0), end = std::min(x + half + 1, picture.width());
    for (const int row : {y - away, y + away})
      if (row >= 0 && row < picture.height() && row_has(picture.row(row), colour, begin, end)) return true;
  }
  return false;
}

/// 255 where the colours of two rows are unlike, 0 elsewhere.
void mark_unlike(std::span<const Rgb8> drawn, std::span<const Rgb8> target, std::span<std::uint8_t> marks) {
  const Words words;
  const Bytes bytes;
  const hn::RebindToSigned<Words> integers;
  const auto white = hn::Set(words, std::uint16_t{255});
  const std::size_t lanes = hn::Lanes(words);
  std::size_t x = 0;
  for (; x + lanes <= marks.size(); x += lanes) {
    auto red = hn::Zero(bytes), green = red, blue = red;
    hn::LoadInterleaved3(bytes, &target[x].r, red, green, blue);
    const auto unlike = hn::IfThenZeroElse(are_like(&drawn[x], red, green, blue), white);
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(integers, unlike)), bytes, &marks[x]);
  }
  for (; x < marks.size(); ++x) marks[x] = is_like(drawn[x], target[x]) ? 0 : 255;
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(disc_has);
HWY_EXPORT(mark_unlike);

NearColours::NearColours(ImageView<const Rgb8> picture) : picture_(picture) {
  const double radius_px = nearness_px(picture.width());
  for (int y = 0; y <= static_cast<int>(radius_px); ++y)
    half_widths_.push_back(static_cast<int>(std::sqrt(radius_px * radius_px - static_cast<double>(y) * y)));
}

bool NearColours::has(Rgb8 colour, int x, int y) const {
  return HWY_DYNAMIC_DISPATCH(disc_has)(picture_, half_widths_, colour, x, y);
}

Image<std::uint8_t> residual(ImageView<const Rgb8> drawn, ImageView<const Rgb8> target) {
  assert(drawn.width() == target.width() && drawn.height() == target.height());
  const NearColours near(target);
  Image<std::uint8_t> wrong(drawn.width(), drawn.height());
  tbb::parallel_for(0, drawn.height(), [&](int y) {
    const auto colours = drawn.row(y);
    const auto marks = wrong.row(y);
    // Nearly all pixels are like the one at their own place.
    HWY_DYNAMIC_DISPATCH(mark_unlike)(colours, target.row(y), marks);
    for (std::size_t x = 0; x < marks.size(); ++x) {
      const void* const next = std::memchr(&marks[x], 255, marks.size() - x);
      if (next == nullptr) break;
      x = static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - marks.data());
      if (near.has(colours[x], static_cast<int>(x), y)) marks[x] = 0;
    }
  });
  return wrong;
}

}  // namespace wheatstone
#endif  // HWY_ONCE
