#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>

#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/measures/wrong_spots_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/measures/wrong_spots_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether any of `count` colours of a row, from a column of the planes on, is like this one.
bool row_has(const ColoursAround& colours, Rgb8 colour, int row, int column, int count) {
  const hn::CappedTag<std::uint16_t, 32> words;
  const hn::Rebind<std::uint8_t, decltype(words)> bytes;
  const int lanes = static_cast<int>(hn::Lanes(words));
  constexpr auto most = static_cast<std::uint16_t>(unlike_colours * unlike_colours);
  for (int i = 0; i < count; i += lanes) {
    const auto squared = [&](const Image<std::uint8_t>& plane, std::uint8_t level) {
      const auto there = hn::PromoteTo(words, hn::LoadU(bytes, plane.row(row).data() + column + i));
      const auto own = hn::Set(words, level);
      const auto difference = hn::Sub(hn::Max(there, own), hn::Min(there, own));
      return hn::Mul(difference, difference);  // at most 255 squared, which a word holds
    };
    const auto sum =
        hn::SaturatedAdd(hn::SaturatedAdd(squared(colours.red, colour.r), squared(colours.green, colour.g)),
                         squared(colours.blue, colour.b));
    const auto is_like = hn::Eq(sum, hn::Min(sum, hn::Set(words, most)));
    if (!hn::AllFalse(words, hn::And(is_like, hn::FirstN(words, static_cast<std::size_t>(count - i))))) return true;
  }
  return false;
}

bool disc_has(const ColoursAround& colours, Rgb8 colour, int x, int y) {
  const int height = colours.red.height(), reach = static_cast<int>(colours.half_widths.size()) - 1;
  for (int away = 0; away <= reach; ++away) {
    const int half = colours.half_widths[static_cast<std::size_t>(away)], column = x + reach - half;
    for (const int row : {y - away, y + away})
      if (row >= 0 && row < height && row_has(colours, colour, row, column, 2 * half + 1)) return true;
  }
  return false;
}

/// The channels of a row's colours.
void separate_channels(std::span<const Rgb8> from, std::uint8_t* red, std::uint8_t* green, std::uint8_t* blue) {
  const hn::CappedTag<std::uint8_t, 32> bytes;
  const std::size_t lanes = hn::Lanes(bytes);
  std::size_t x = 0;
  for (; x + lanes <= from.size(); x += lanes) {
    auto r = hn::Zero(bytes), g = r, b = r;
    hn::LoadInterleaved3(bytes, &from[x].r, r, g, b);
    hn::StoreU(r, bytes, red + x);
    hn::StoreU(g, bytes, green + x);
    hn::StoreU(b, bytes, blue + x);
  }
  for (; x < from.size(); ++x) {
    red[x] = from[x].r;
    green[x] = from[x].g;
    blue[x] = from[x].b;
  }
}

/// As mark_unlike_colours.
void mark_unlike_row(std::span<const Rgb8> a, std::span<const Rgb8> b, std::span<std::uint8_t> marks) {
  const hn::CappedTag<std::uint16_t, 32> words;
  const hn::Rebind<std::uint8_t, decltype(words)> bytes;
  const hn::RebindToSigned<decltype(words)> integers;
  constexpr auto most = static_cast<std::uint16_t>(unlike_colours * unlike_colours);
  const auto white = hn::Set(words, std::uint16_t{255});
  const std::size_t lanes = hn::Lanes(words);
  std::size_t x = 0;
  for (; x + lanes <= marks.size(); x += lanes) {
    auto red = hn::Zero(bytes), green = red, blue = red, other_red = red, other_green = red, other_blue = red;
    hn::LoadInterleaved3(bytes, &a[x].r, red, green, blue);
    hn::LoadInterleaved3(bytes, &b[x].r, other_red, other_green, other_blue);
    const auto squared = [&](auto level, auto other) {
      const auto difference = hn::PromoteTo(words, hn::Sub(hn::Max(level, other), hn::Min(level, other)));
      return hn::Mul(difference, difference);  // at most 255 squared, which a word holds
    };
    const auto sum = hn::SaturatedAdd(hn::SaturatedAdd(squared(red, other_red), squared(green, other_green)),
                                      squared(blue, other_blue));
    const auto alike = hn::Eq(sum, hn::Min(sum, hn::Set(words, most)));
    const auto unlike = hn::IfThenZeroElse(alike, white);
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(integers, unlike)), bytes, &marks[x]);
  }
  for (; x < marks.size(); ++x) marks[x] = is_like(a[x], b[x]) ? 0 : 255;
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(disc_has);
HWY_EXPORT(separate_channels);
HWY_EXPORT(mark_unlike_row);

void mark_unlike_colours(std::span<const Rgb8> a, std::span<const Rgb8> b, std::span<std::uint8_t> marks) {
  HWY_DYNAMIC_DISPATCH(mark_unlike_row)(a, b, marks);
}

ColoursAround::ColoursAround(ImageView<const Rgb8> photograph) {
  constexpr int widest_vector = 32;
  const double radius_px = nearness_px(photograph.width());
  const int reach = static_cast<int>(radius_px), width = photograph.width();
  for (int y = 0; y <= reach; ++y)
    half_widths.push_back(static_cast<int>(std::sqrt(radius_px * radius_px - static_cast<double>(y) * y)));
  for (Image<std::uint8_t>* plane : {&red, &green, &blue})
    *plane = Image<std::uint8_t>(width + 2 * reach + widest_vector, photograph.height());
  tbb::parallel_for(0, photograph.height(), [&](int y) {
    const auto from = photograph.row(y);
    const auto to_red = red.row(y), to_green = green.row(y), to_blue = blue.row(y);
    HWY_DYNAMIC_DISPATCH(separate_channels)
    (from, to_red.data() + reach, to_green.data() + reach, to_blue.data() + reach);
    for (const auto& [plane, first, last] :
         {std::tuple(to_red, from.front().r, from.back().r), std::tuple(to_green, from.front().g, from.back().g),
          std::tuple(to_blue, from.front().b, from.back().b)}) {
      std::fill_n(plane.begin(), reach, first);
      std::fill(plane.begin() + reach + width, plane.end(), last);
    }
  });
}

bool ColoursAround::has(Rgb8 colour, int x, int y) const { return HWY_DYNAMIC_DISPATCH(disc_has)(*this, colour, x, y); }

}  // namespace wheatstone
#endif  // HWY_ONCE
