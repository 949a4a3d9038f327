#include <algorithm>
#include <array>
#include <limits>

#include "wheatstone/multiview/triangle_band_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/multiview/triangle_band_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, TriangleBand::block>;
using Ints = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;
using Vec = hn::Vec<Floats>;

/// What triangles fill of a line in one view: samples begin, … end − 1, where sample c is as near as start + c·by_x.
struct Fillings {
  static constexpr std::size_t most = 256;
  static constexpr std::size_t room = most + TriangleBand::block;
  std::array<std::int32_t, room> begin, end;
  std::array<float, room> start, by_x;
  std::array<std::uint32_t, room> triangle;
};

/// A vector's worth of crossings, of which those behind the last are between no samples.
struct SomeCrossings {
  Vec x0, disparity0, x1, disparity1, nearness0, nearness1;
  hn::Vec<Words> triangle;
};

HWY_INLINE SomeCrossings load_crossings(const CrossedLine& line, std::size_t first) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  const CrossedLine::Edges* edges = line.edges.data() + first;
  const CrossedLine::Between* between = line.between.data() + first;
  std::array<CrossedLine::Edges, TriangleBand::block> last_edges{};
  std::array<CrossedLine::Between, TriangleBand::block> last_between{};
  if (const std::size_t rest = line.edges.size() - first; rest < lanes) {
    std::copy_n(edges, rest, last_edges.begin());
    std::copy_n(between, rest, last_between.begin());
    edges = last_edges.data();
    between = last_between.data();
  }
  SomeCrossings some;
  hn::LoadInterleaved4(d, &edges->x0, some.x0, some.disparity0, some.x1, some.disparity1);
  Vec triangle;
  hn::LoadInterleaved3(d, &between->nearness0, some.nearness0, some.nearness1, triangle);
  some.triangle = hn::BitCast(Words(), triangle);
  return some;
}

/// Puts what a vector's worth of triangles fills behind the first `count` fillings; returns how many there are then.
HWY_INLINE std::size_t put_fillings(const SomeCrossings& some, float column, float view, int width, Fillings& to,
                                    std::size_t count) {
  const Floats d;
  const Ints di;
  const Vec v = hn::Set(d, view), sample = hn::Set(d, column);
  const Vec x0 = hn::Sub(some.x0, hn::Mul(v, some.disparity0)), x1 = hn::Sub(some.x1, hn::Mul(v, some.disparity1));
  const Vec left = hn::Min(x0, x1), right = hn::Max(x0, x1);
  const auto begin = hn::Max(hn::ConvertTo(di, hn::Ceil(hn::Sub(left, sample))), hn::Zero(di));
  const auto end = hn::Min(hn::ConvertTo(di, hn::Ceil(hn::Sub(right, sample))), hn::Set(di, width));
  // Most triangles that are smaller than the distance of samples lie between two of them.
  const auto fills = hn::Lt(begin, end);
  const auto is_turned = hn::Lt(x1, x0);
  const Vec near_left = hn::IfThenElse(is_turned, some.nearness1, some.nearness0);
  const Vec near_right = hn::IfThenElse(is_turned, some.nearness0, some.nearness1);
  // In a narrower part, the slope would be lost in rounding errors.
  constexpr float narrow_px = 1.f / 64;
  const Vec across = hn::Sub(right, left);
  const auto is_narrow = hn::Lt(across, hn::Set(d, narrow_px));
  const Vec by_x = hn::IfThenElse(is_narrow, hn::Zero(d),
                                  hn::Div(hn::Sub(near_right, near_left), hn::Max(across, hn::Set(d, narrow_px))));
  const Vec middle = hn::Mul(hn::Add(near_left, near_right), hn::Set(d, 0.5f));
  const Vec start = hn::IfThenElse(is_narrow, middle, hn::Add(near_left, hn::Mul(hn::Sub(sample, left), by_x)));
  hn::CompressStore(begin, hn::RebindMask(di, fills), di, to.begin.data() + count);
  hn::CompressStore(end, hn::RebindMask(di, fills), di, to.end.data() + count);
  hn::CompressStore(start, hn::RebindMask(d, fills), d, to.start.data() + count);
  hn::CompressStore(by_x, hn::RebindMask(d, fills), d, to.by_x.data() + count);
  return count + hn::CompressStore(some.triangle, hn::RebindMask(Words(), fills), Words(), to.triangle.data() + count);
}

/// Fills samples in blocks that begin at multiples of their size, so that a block that was just written is read whole.
HWY_INLINE void fill(const Fillings& fillings, std::size_t count, float* nearest, std::uint32_t* shown) {
  const Floats d;
  const Ints di;
  const Words dw;
  const auto from_0 = hn::Iota(di, 0);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (std::size_t n = 0; n < count; ++n) {
    const auto begin = hn::Set(di, fillings.begin[n]), end = hn::Set(di, fillings.end[n]);
    const Vec start = hn::Set(d, fillings.start[n]), by_x = hn::Set(d, fillings.by_x[n]);
    const auto triangle = hn::Set(dw, fillings.triangle[n]);
    for (int at = fillings.begin[n] / lanes * lanes; at < fillings.end[n]; at += lanes) {
      const auto place = hn::Add(hn::Set(di, at), from_0);
      const auto is_between = hn::AndNot(hn::Lt(place, begin), hn::Lt(place, end));
      const Vec near = hn::Add(start, hn::Mul(hn::ConvertTo(d, place), by_x));
      const Vec before = hn::LoadU(d, nearest + at);
      const auto is_nearest = hn::And(hn::RebindMask(d, is_between), hn::Gt(near, before));
      hn::StoreU(hn::IfThenElse(is_nearest, near, before), d, nearest + at);
      hn::StoreU(hn::IfThenElse(hn::RebindMask(dw, is_nearest), triangle, hn::LoadU(dw, shown + at)), dw, shown + at);
    }
  }
}

void show_crossed_line(const CrossedLine& line, float column, float view, int width, float* nearest,
                       std::uint32_t* shown) {
  const std::size_t lanes = hn::Lanes(Floats());
  Fillings fillings;
  std::size_t count = 0;
  for (std::size_t first = 0; first < line.edges.size(); first += lanes) {
    count = put_fillings(load_crossings(line, first), column, view, width, fillings, count);
    if (count <= Fillings::most - TriangleBand::block) continue;
    fill(fillings, count, nearest, shown);
    count = 0;
  }
  fill(fillings, count, nearest, shown);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(show_crossed_line);

void TriangleBand::show(float view) {
  std::ranges::fill(nearest_, -std::numeric_limits<float>::infinity());
  std::ranges::fill(shown_, nothing);
  for (std::size_t line = 0; line * stride_ < nearest_.size(); ++line) {
    const float column = columns_[line % static_cast<std::size_t>(samples_)];
    HWY_DYNAMIC_DISPATCH(show_crossed_line)
    (lines_[line], column, view, width_, nearest_.data() + line * stride_, shown_.data() + line * stride_);
  }
}

}  // namespace wheatstone
#endif  // HWY_ONCE
