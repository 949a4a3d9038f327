#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/band_hiding_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, Canvas::widest_vector>;
constexpr float everything = std::numeric_limits<float>::infinity();

/// The surfaces' disparities, from one column of a row on.
struct SurfacesAt {
  const float *nearest, *reference, *photographed;
};

/// Collects what hides one kind of marks in a band, row by row.
struct KindAtWork {
  KindAtWork(HiddenBelow& below_, const DistanceBand& band, int width)
      : below(below_),
        rows(band.row_count),
        most(static_cast<std::size_t>(band.stride), -everything),
        least(static_cast<std::size_t>(band.stride), everything) {
    const int blocks = (width + HiddenBelow::block_px - 1) / HiddenBelow::block_px;
    below.shown_columns.resize(static_cast<std::size_t>(blocks * rows) + Canvas::widest_vector);
  }

  /// `value`: the disparities below which a mark is hidden, from the column `x` of a row on.
  HWY_INLINE void note(hn::Vec<Floats> value, int row, int x) {
    const Floats f;
    hn::StoreU(hn::Max(hn::LoadU(f, most.data() + x), value), f, most.data() + x);
    hn::StoreU(hn::Min(hn::LoadU(f, least.data() + x), value), f, least.data() + x);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(f, hn::Lt(value, hn::Set(f, everything)), bits);
    const int number = x / HiddenBelow::block_px, first = x % HiddenBelow::block_px;
    std::uint16_t& shown = below.shown_columns[place_in_blocks(row, number, rows)];
    shown = static_cast<std::uint16_t>(shown | (bits[0] | bits[1] << 8) << first);
  }

  /// To be called once all rows are noted.
  void sum_up_blocks(int width) {
    for (int first = 0, number = 0; first < width; first += HiddenBelow::block_px, ++number) {
      const int end = std::min(first + HiddenBelow::block_px, width);
      std::uint32_t shown = 0;
      for (int row = 0; row < rows; ++row)
        if (below.shown_columns[place_in_blocks(row, number, rows)] != 0) shown |= std::uint32_t{1} << row;
      below.blocks.push_back({*std::max_element(most.begin() + first, most.begin() + end),
                              *std::min_element(least.begin() + first, least.begin() + end), shown});
    }
  }

  HiddenBelow& below;
  int rows;
  std::vector<float> most, least;  ///< largest and smallest noted value of each column
};

/// All kinds of marks that occur, the reference view's first.
struct KindsAtWork {
  std::vector<KindAtWork> kinds;
  float* nearest_below;  ///< disparity below which the reference view's marks are hidden
  float* most_of_rows;   ///< of that
  int rows;
  float tolerance_px;
};

/// Notes the disparities below which marks of each kind are hidden, in a vector's columns: least_seen_disparity and
/// least_seen_of_other.
HWY_INLINE void hide_columns(const SurfacesAt& surfaces, int row, int x, std::size_t at, KindsAtWork& at_work) {
  const Floats f;
  const auto tolerance = hn::Set(f, at_work.tolerance_px), all = hn::Set(f, everything);
  const auto nearest = hn::LoadU(f, surfaces.nearest);
  const auto below = hn::IfThenElse(hn::IsNaN(nearest), hn::Neg(all), hn::Sub(nearest, tolerance));
  hn::StoreU(below, f, at_work.nearest_below + at);
  float& most = at_work.most_of_rows[x / HiddenBelow::block_px * at_work.rows + row];
  most = std::max(most, hn::GetLane(hn::MaxOfLanes(f, below)));
  at_work.kinds[0].note(below, row, x);
  if (surfaces.reference == nullptr) return;
  const auto reference = hn::LoadU(f, surfaces.reference), photographed = hn::LoadU(f, surfaces.photographed);
  const auto unless_shown = [&](auto shown) {
    return hn::IfThenElse(hn::Le(nearest, hn::Add(shown, tolerance)), all, below);
  };
  at_work.kinds[1].note(unless_shown(reference), row, x);
  at_work.kinds[2].note(unless_shown(photographed), row, x);
  at_work.kinds[3].note(hn::IfThenElse(hn::IsNaN(photographed), all, below), row, x);
}

void hide_row(const SurfacesAt& surfaces, int row, int width, std::size_t at, KindsAtWork& at_work) {
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  const auto from = [](const float* surface, int x) { return surface == nullptr ? nullptr : surface + x; };
  int x = 0;
  for (; x + lanes <= width; x += lanes)
    hide_columns({surfaces.nearest + x, from(surfaces.reference, x), from(surfaces.photographed, x)}, row, x,
                 at + static_cast<std::size_t>(x), at_work);
  if (x >= width) return;
  std::array<std::array<float, Canvas::widest_vector>, 3> last{};
  const auto copied = [&](const float* surface, std::size_t i) -> const float* {
    for (int column = x; surface != nullptr && column < width; ++column)
      last[i][static_cast<std::size_t>(column - x)] = surface[column];
    return surface == nullptr ? nullptr : last[i].data();
  };
  hide_columns({copied(surfaces.nearest, 0), copied(surfaces.reference, 1), copied(surfaces.photographed, 2)}, row, x,
               at + static_cast<std::size_t>(x), at_work);
}

void hide_band(const Hiding& hiding, const DistanceBand& band, int width, BandHiding& hides) {
  const ImageView<const float>& photographed = hiding.photographed.empty() ? hiding.reference : hiding.photographed;
  const bool has_others = !hiding.reference.empty();
  hides.nearest_below.resize(band.squared.size(), -everything);
  const int blocks = (width + HiddenBelow::block_px - 1) / HiddenBelow::block_px;
  hides.most_of_rows.resize(static_cast<std::size_t>(blocks * band.row_count) + Canvas::widest_vector, -everything);
  KindsAtWork at_work{{}, hides.nearest_below.data(), hides.most_of_rows.data(), band.row_count, hiding.tolerance_px};
  const std::array<HiddenBelow*, 4> kinds{&hides.own, &hides.other, &hides.continued, &hides.gaps};
  for (HiddenBelow* below : std::span(kinds).first(has_others ? 4 : 1)) {
    below->pixels = hides.nearest_below;
    below->most_of_rows = hides.most_of_rows;
    at_work.kinds.emplace_back(*below, band, width);
  }
  for (int row = 0; row < band.row_count; ++row) {
    const int y = band.top + row - hiding.first_row;
    const SurfacesAt surfaces{hiding.surface.row(y).data(), has_others ? hiding.reference.row(y).data() : nullptr,
                              has_others ? photographed.row(y).data() : nullptr};
    hide_row(surfaces, row, width, static_cast<std::size_t>(row) * band.stride, at_work);
  }
  for (KindAtWork& kind : at_work.kinds) kind.sum_up_blocks(width);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(hide_band);

BandHiding::BandHiding(const Hiding& hiding, const DistanceBand& band, int canvas_width) {
  if (!hiding.surface.empty()) HWY_DYNAMIC_DISPATCH(hide_band)(hiding, band, canvas_width, *this);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
