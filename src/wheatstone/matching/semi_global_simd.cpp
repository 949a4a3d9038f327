#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "wheatstone/matching/semi_global_strip_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/matching/semi_global_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Sums = hn::CappedTag<std::uint16_t, band_step>;
using Costs = hn::Rebind<std::uint8_t, Sums>;
using Bytes = hn::CappedTag<std::uint8_t, row_margin>;
using Sum = hn::Vec<Sums>;

constexpr int census_planes = 8, channels = 3, path_count = 4;
constexpr int most_colour_cost = 30, outside_cost = 30, past_band_cost = 255;
constexpr int small_step_cost = 60, large_step_cost = 500;  // P1 and P2
constexpr std::uint16_t unreachable = 12000, no_sum = 0xFFFF;

/// The least lane. Halved first: for eight lanes there is one instruction.
HWY_INLINE std::uint16_t least_lane(Sum sums) {
  const Sums d;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(d) > 8) {
    const hn::Half<Sums> half;
    return hn::GetLane(hn::MinOfLanes(half, hn::Min(hn::LowerHalf(half, sums), hn::UpperHalf(half, sums))));
  }
#endif
  return hn::GetLane(hn::MinOfLanes(d, sums));
}

/// Several values of each pixel of a row, value by value, with a margin at both ends.
class Planes {
 public:
  Planes(int planes, int width)
      : stride_(static_cast<std::size_t>(width + 2 * row_margin)), values_(planes * stride_ + row_margin) {}
  std::uint8_t* operator[](int plane) { return &values_[plane * stride_ + row_margin]; }
  const std::uint8_t* operator[](int plane) const { return &values_[plane * stride_ + row_margin]; }

 private:
  std::size_t stride_;
  std::vector<std::uint8_t> values_;
};

/// A bit a neighbour: whether it is darker than the pixel; eight of them a plane. `mirrored` reads the neighbours of a
/// mirrored picture in the order of the other one's.
void census_row(const cv::Mat& grey, int y, int width, bool mirrored, Planes& census) {
  constexpr int across = 2 * census_across + 1, all = across * (2 * census_down + 1), own_index = all / 2;
  const Bytes d;
  std::array<const std::uint8_t*, all> neighbours{};
  for (int i = 0; i < all; ++i)
    neighbours[i] = grey.ptr<std::uint8_t>(y + i / across) + (mirrored ? across - 1 - i % across : i % across);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const auto own = hn::LoadU(d, neighbours[own_index] + x);
    for (int plane = 0; plane < census_planes; ++plane) {
      auto bits = hn::Zero(d);
      for (int i = 8 * plane; i < std::min(8 * plane + 8, all); ++i) {
        const auto darker = hn::VecFromMask(d, hn::Lt(hn::LoadU(d, neighbours[i] + x), own));
        bits = hn::Sub(hn::Add(bits, bits), darker);
      }
      hn::StoreU(bits, d, census[plane] + x);
    }
  }
}

void colour_row(const cv::Mat& picture, int y, Planes& colours) {
  const int width = picture.cols;
  const auto* from = picture.ptr<std::uint8_t>(y);
  for (int x = 0; x < width; ++x)
    for (int channel = 0; channel < channels; ++channel) colours[channel][x] = from[channels * x + channel];
}

/// The least and the largest of each channel over half a pixel to either side.
void colour_spread_row(Planes& colours, int width, Planes& least, Planes& most) {
  const Bytes d;
  for (int channel = 0; channel < channels; ++channel) {
    std::uint8_t* of = colours[channel];
    of[-1] = of[0];
    of[width] = of[width - 1];
    for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
      const auto own = hn::LoadU(d, of + x);
      const auto before = hn::LoadU(d, of + x - 1), after = hn::LoadU(d, of + x + 1);
      // Rounded away from the pixel's own value: down where the neighbour is darker.
      const auto darker = hn::Min(before, after), lighter = hn::Max(before, after);
      const auto down = hn::Not(hn::AverageRound(hn::Not(own), hn::Not(darker)));
      hn::StoreU(hn::Min(own, down), d, least[channel] + x);
      hn::StoreU(hn::Max(own, hn::AverageRound(own, lighter)), d, most[channel] + x);
    }
  }
}

/// One row of both pictures, as costs compare it.
struct ComparedRow {
  explicit ComparedRow(int width)
      : left_census(census_planes, width),
        right_census(census_planes, width),
        left(channels, width),
        right(channels, width),
        right_least(channels, width),
        right_most(channels, width) {}

  void take(const ComparedPictures& pictures, int y) {
    const int width = pictures.left.cols;
    census_row(pictures.left_grey, y, width, false, left_census);
    census_row(pictures.right_grey, y, width, true, right_census);
    colour_row(pictures.left, y, left);
    colour_row(pictures.right, y, right);
    colour_spread_row(right, width, right_least, right_most);
  }

  Planes left_census, right_census, left, right, right_least, right_most;
};

/// Costs of a pixel at as many disparities as a vector has lanes, the first of which leads to column `there` of the
/// mirrored picture.
HWY_INLINE hn::Vec<Costs> compare(const ComparedRow& row, int x, int there) {
  const Costs d;
  const Sums ds;
  auto differing = hn::Zero(d);
  for (int plane = 0; plane < census_planes; ++plane) {
    const auto own = hn::Set(d, row.left_census[plane][x]);
    differing = hn::Add(differing, hn::PopulationCount(hn::Xor(own, hn::LoadU(d, row.right_census[plane] + there))));
  }
  auto colour = hn::Zero(ds);
  for (int channel = 0; channel < channels; ++channel) {
    const auto own = hn::Set(d, row.left[channel][x]);
    const auto below = hn::SaturatedSub(hn::LoadU(d, row.right_least[channel] + there), own);
    const auto above = hn::SaturatedSub(own, hn::LoadU(d, row.right_most[channel] + there));
    colour = hn::Add(colour, hn::PromoteTo(ds, hn::Max(below, above)));
  }
  constexpr std::uint16_t third = 21846;  // of 2^16
  colour = hn::Min(hn::MulHigh(colour, hn::Set(ds, third)), hn::Set(ds, std::uint16_t{most_colour_cost}));
  const hn::RebindToSigned<Sums> dsigned;
  return hn::Add(differing, hn::DemoteTo(d, hn::BitCast(dsigned, colour)));
}

void compare_row(const ComparedRow& row, std::span<const std::int16_t> first, int count, std::uint8_t* costs) {
  const Costs d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = static_cast<int>(first.size());
  const int rounded = (count + band_step - 1) / band_step * band_step;
  for (int x = 0; x < width; ++x, costs += rounded) {
    for (int k = 0; k < rounded; k += lanes) {
      const int there = width - 1 - x + first[x] + k;
      if (there <= -lanes || there >= width) {
        hn::StoreU(hn::Set(d, std::uint8_t{outside_cost}), d, costs + k);
        continue;
      }
      hn::StoreU(compare(row, x, there), d, costs + k);
      for (int i = 0; i < std::min(-there, lanes); ++i) costs[k + i] = outside_cost;
      for (int i = std::max(width - there, 0); i < lanes; ++i) costs[k + i] = outside_cost;
    }
    for (int k = count; k < rounded; ++k) costs[k] = past_band_cost;
  }
}

/// The costs of one path to each pixel of a row, or to the last few. Beside each band lies room for disparities out of
/// reach.
struct PathRow {
  static constexpr int few = 8;  // a power of two

  PathRow(int width, int band, int room, bool whole)
      : stride(band + room),
        beside(room),
        kept(whole ? std::numeric_limits<int>::max() : few - 1),
        values(static_cast<std::size_t>(whole ? width : few) * stride + room, unreachable),
        least(whole ? width : few, 0) {}
  std::uint16_t* at(int x) { return &values[static_cast<std::size_t>(x & kept) * stride + beside]; }
  std::uint16_t& least_at(int x) { return least[x & kept]; }
  int stride, beside;
  int kept;  ///< the bits of a column that tell its place
  std::vector<std::uint16_t> values;
  std::vector<std::uint16_t> least;
};

/// One path's step from the pixel before it, `from` with its least value, to a pixel's `to`; Hirschmüller 2008, eq. 13.
struct PathStep {
  const std::uint16_t* from;
  std::uint16_t* to;
  std::uint16_t* to_least;
  std::uint16_t least, large_step;
};

template <bool first_paths>
HWY_INLINE void extend_paths(const std::array<PathStep, path_count>& steps, const std::uint8_t* costs, int rounded,
                             std::uint16_t* sums) {
  const Sums d;
  const Costs dc;
  const Sum small = hn::Set(d, std::uint16_t{small_step_cost});
  Sum least[path_count];
  for (Sum& none : least) none = hn::Set(d, no_sum);
  for (int k = 0; k < rounded; k += static_cast<int>(hn::Lanes(d))) {
    const Sum cost = hn::PromoteTo(d, hn::LoadU(dc, costs + k));
    Sum sum = first_paths ? hn::Zero(d) : hn::LoadU(d, sums + k);
    for (int path = 0; path < path_count; ++path) {
      const PathStep& step = steps[path];
      const Sum beside = hn::Min(hn::LoadU(d, step.from + k - 1), hn::LoadU(d, step.from + k + 1));
      const Sum jump = hn::Set(d, static_cast<std::uint16_t>(step.least + step.large_step));
      const Sum best = hn::Min(hn::Min(hn::LoadU(d, step.from + k), hn::Add(beside, small)), jump);
      const Sum value = hn::Add(hn::Sub(best, hn::Set(d, step.least)), cost);
      hn::StoreU(value, d, step.to + k);
      sum = hn::Add(sum, value);
      least[path] = hn::Min(least[path], value);
    }
    hn::StoreU(sum, d, sums + k);
  }
  for (int path = 0; path < path_count; ++path) *steps[path].to_least = least_lane(least[path]);
}

/// P2 by the difference of two greys: depth may jump at edges.
constexpr std::array<std::uint16_t, 256> large_steps = [] {
  std::array<std::uint16_t, 256> steps{};
  for (int edge = 0; edge < 256; ++edge)
    steps[edge] = static_cast<std::uint16_t>(std::max(small_step_cost + 3, large_step_cost * 8 / (8 + edge)));
  return steps;
}();

/// A strip being matched: its volumes, and the paths to the rows at hand and the one before.
class StripMatcher {
 public:
  StripMatcher(const ComparedPictures& pictures, const SearchBand& band, const Strip& strip, StripMemory& memory)
      : pictures_(pictures),
        band_(band),
        strip_(strip),
        memory_(memory),
        width_(pictures.left.cols),
        rounded_((band.count + band_step - 1) / band_step * band_step),
        farthest_(pictures.one_band ? 0 : rounded_ + 1),
        beginning_(static_cast<std::size_t>(rounded_) + 2, 0) {
    const auto size = static_cast<std::size_t>(strip.bottom - strip.top) * width_ * rounded_;
    memory_.costs.resize(std::max(memory_.costs.size(), size));
    memory_.sums.resize(std::max(memory_.sums.size(), size));
  }

  void match(BandMatch& result) {
    ComparedRow row(width_);
    begin_paths();
    for (int y = strip_.top; y < strip_.bottom; y += rows_at_once) {
      const int end = std::min(y + rows_at_once, strip_.bottom);
      for (int i = y; i < end; ++i) {
        row.take(pictures_, i);
        compare_row(row, band_.first.row(i), band_.count, &memory_.costs[at(i)]);
      }
      // What leads paths upwards needs none downwards.
      if (y < strip_.end) add_paths<true>(y, std::min(end, strip_.end) - y);
    }
    begin_paths();
    for (int y = strip_.bottom - 1; y >= strip_.begin; y -= rows_at_once) {
      const int count = std::min(rows_at_once, y + 1 - strip_.begin);
      add_paths<false>(y, count);
      for (int i = y; i > y - count; --i)
        if (i < strip_.end) choose_row(i, result);
    }
  }

 private:
  static constexpr int rows_at_once = 4;
  using Paths = std::vector<PathRow>;

  /// A row and the paths to its pixels; none outside the strip.
  struct RowOfPaths {
    Paths* paths = nullptr;
    const std::int16_t* first = nullptr;  ///< of each pixel's band
    const std::uint8_t* grey = nullptr;
    std::size_t place = 0;  ///< of its costs and sums
  };

  std::size_t at(int y) const { return static_cast<std::size_t>(y - strip_.top) * width_ * rounded_; }

  void begin_paths() {
    now_.assign(path_count, PathRow(width_, rounded_, farthest_ + 1, true));
    before_ = now_;
    between_.fill(Paths(path_count, PathRow(width_, rounded_, farthest_ + 1, false)));
  }

  RowOfPaths row_of_paths(int y, Paths& paths) const {
    if (y < strip_.top || y >= strip_.bottom) return {};
    return {&paths, band_.first.row(y).data(), pictures_.left_grey.ptr<std::uint8_t>(y + census_down) + census_across,
            at(y)};
  }

  /// Adds the paths from above and from the left, `downwards`, or from below and from the right, to `count` rows from
  /// `y` on. Along a row each pixel waits for the one before it, but not for those of other rows: several rows are gone
  /// along at once, each as far behind the one before it as its paths need.
  template <bool downwards>
  void add_paths(int y, int count) {
    constexpr int direction = downwards ? 1 : -1, behind = 2;
    static_assert(PathRow::few > behind + 1);
    std::array<RowOfPaths, rows_at_once + 1> rows{row_of_paths(y - direction, before_)};
    for (int i = 0; i < count; ++i) rows[i + 1] = row_of_paths(y + direction * i, i + 1 == count ? now_ : between_[i]);
    for (int place = 0; place < width_ + behind * (count - 1); ++place) {
      for (int i = 0; i < count; ++i) {
        const int along = place - behind * i;
        if (along >= 0 && along < width_)
          extend_to<downwards>(downwards ? along : width_ - 1 - along, rows[i], rows[i + 1]);
      }
    }
    std::swap(now_, before_);
  }

  template <bool downwards>
  HWY_INLINE void extend_to(int x, const RowOfPaths& before, const RowOfPaths& row) {
    constexpr int direction = downwards ? 1 : -1;
    const std::array<PathStep, path_count> steps{step(0, x, row, x - direction, row), step(1, x, row, x, before),
                                                 step(2, x, row, x - direction, before),
                                                 step(3, x, row, x + direction, before)};
    const std::size_t pixel = row.place + static_cast<std::size_t>(x) * rounded_;
    extend_paths<downwards>(steps, &memory_.costs[pixel], rounded_, &memory_.sums[pixel]);
  }

  /// A path's step to a pixel of a row from the one before it.
  HWY_INLINE PathStep step(int path, int x, const RowOfPaths& row, int from_x, const RowOfPaths& from_row) const {
    PathRow& to = (*row.paths)[path];
    if (from_row.paths == nullptr || from_x < 0 || from_x >= width_)
      return {beginning_.data() + 1, to.at(x), &to.least_at(x), 0, 0};
    PathRow& from = (*from_row.paths)[path];
    const int shift = std::clamp(row.first[x] - from_row.first[from_x], -farthest_, farthest_);
    return {from.at(from_x) + shift, to.at(x), &to.least_at(x), from.least_at(from_x),
            large_steps[std::abs(row.grey[x] - from_row.grey[from_x])]};
  }

  /// The place of the least of a pixel's sums, the first of equal ones.
  HWY_INLINE int least_of(const std::uint16_t* sums) const {
    const Sums d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    Sum least = hn::LoadU(d, sums);
    for (int k = lanes; k < rounded_; k += lanes) least = hn::Min(least, hn::LoadU(d, sums + k));
    least = hn::Set(d, least_lane(least));
    for (int k = 0; k < rounded_; k += lanes) {
      const auto found = hn::FindFirstTrue(d, hn::Eq(hn::LoadU(d, sums + k), least));
      if (found >= 0) return k + static_cast<int>(found);
    }
    return 0;
  }

  std::uint8_t mean_of(const std::uint8_t* costs) const {
    int sum = 0;
    for (int k = 0; k < band_.count; ++k) sum += costs[k];
    return static_cast<std::uint8_t>(sum / band_.count);
  }

  /// The offset of the lowest point of two lines of opposite slope through three sums, the middle one the least.
  float between_pixels(const std::uint16_t* sums, int k) const {
    if (k == 0 || k == band_.count - 1) return 0;
    const int before = sums[k - 1] - sums[k], after = sums[k + 1] - sums[k];
    const int steeper = std::max(before, after);
    return steeper > 0 ? static_cast<float>(before - after) / static_cast<float>(2 * steeper) : 0;
  }

  /// Each pixel of the left picture takes its least sum, each of the right one the least that leads to it.
  void choose_row(int y, BandMatch& result) {
    const Sums d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto left = result.left.row(y), right = result.right.row(y);
    std::vector<std::uint16_t> least(static_cast<std::size_t>(width_ + 2 * row_margin), no_sum), chosen(least.size());
    std::uint16_t* sums = &memory_.sums[at(y)];
    const std::uint8_t* costs = &memory_.costs[at(y)];
    for (int x = 0; x < width_; ++x, sums += rounded_) {
      std::fill(sums + band_.count, sums + rounded_, no_sum);
      const int first = band_.first(x, y), best = least_of(sums);
      result.own_cost(x, y) = costs[best];
      result.mean_cost(x, y) = mean_of(costs);
      costs += rounded_;
      left[x] = static_cast<float>(first + best) + between_pixels(sums, best);
      for (int k = 0; k < rounded_; k += lanes) {
        const int there = width_ - 1 - x + first + k;
        if (there <= -lanes || there >= width_) continue;
        std::uint16_t* to = &least[there + row_margin];
        std::uint16_t* to_chosen = &chosen[there + row_margin];
        const Sum sum = hn::LoadU(d, sums + k), other = hn::LoadU(d, to);
        // Highway's Iota writes each lane to memory unless it begins with a constant.
        const Sum disparity = hn::Add(hn::Set(d, static_cast<std::uint16_t>(first + k)), hn::Iota(d, 0));
        hn::StoreU(hn::IfThenElse(hn::Lt(sum, other), disparity, hn::LoadU(d, to_chosen)), d, to_chosen);
        hn::StoreU(hn::Min(sum, other), d, to);
      }
    }
    for (int x = 0; x < width_; ++x) {
      const int there = width_ - 1 - x + row_margin;
      if (least[there] != no_sum) right[x] = static_cast<float>(static_cast<std::int16_t>(chosen[there]));
    }
  }

  const ComparedPictures& pictures_;
  const SearchBand& band_;
  const Strip& strip_;
  StripMemory& memory_;
  int width_, rounded_, farthest_;
  std::vector<std::uint16_t> beginning_;
  Paths now_, before_;                           ///< the last row of those gone along at once, and of those before
  std::array<Paths, rows_at_once - 1> between_;  ///< the others
};

void match_strip_part(const ComparedPictures& pictures, const SearchBand& band, const Strip& strip, StripMemory& memory,
                      BandMatch& result) {
  StripMatcher(pictures, band, strip, memory).match(result);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(match_strip_part);

void match_strip(const ComparedPictures& pictures, const SearchBand& band, const Strip& strip, StripMemory& memory,
                 BandMatch& result) {
  HWY_DYNAMIC_DISPATCH(match_strip_part)(pictures, band, strip, memory, result);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
