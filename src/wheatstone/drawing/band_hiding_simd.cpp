#include <algorithm>
#include <array>
#include <limits>

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

/// Some columns of surfaces.
struct SurfacesAt {
  const float *nearest, *reference, *photographed;
};

/// What the marks of each kind must lie before, in a vector's columns: least_seen_disparity and least_seen_of_other.
void hide_columns(const SurfacesAt& surfaces, float tolerance_px, std::size_t at, BandHiding& hiding) {
  const Floats f;
  const auto tolerance = hn::Set(f, tolerance_px), all = hn::Set(f, everything);
  const auto nearest = hn::LoadU(f, surfaces.nearest);
  const auto below = hn::IfThenElse(hn::IsNaN(nearest), hn::Neg(all), hn::Sub(nearest, tolerance));
  hn::StoreU(below, f, hiding.own.pixels.data() + at);
  if (surfaces.reference == nullptr) return;
  const auto reference = hn::LoadU(f, surfaces.reference), photographed = hn::LoadU(f, surfaces.photographed);
  const auto unless_shown = [&](auto shown) {
    return hn::IfThenElse(hn::Le(nearest, hn::Add(shown, tolerance)), all, below);
  };
  hn::StoreU(unless_shown(reference), f, hiding.other.pixels.data() + at);
  hn::StoreU(unless_shown(photographed), f, hiding.continued.pixels.data() + at);
  hn::StoreU(hn::IfThenElse(hn::IsNaN(photographed), all, below), f, hiding.gaps.pixels.data() + at);
}

void hide_row(const SurfacesAt& surfaces, int width, float tolerance_px, std::size_t at, BandHiding& hiding) {
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  const auto from = [](const float* row, int x) { return row == nullptr ? nullptr : row + x; };
  int x = 0;
  for (; x + lanes <= width; x += lanes)
    hide_columns({surfaces.nearest + x, from(surfaces.reference, x), from(surfaces.photographed, x)}, tolerance_px,
                 at + static_cast<std::size_t>(x), hiding);
  if (x >= width) return;
  std::array<std::array<float, Canvas::widest_vector>, 3> last{};
  const auto copied = [&](const float* row, std::size_t i) -> const float* {
    for (int column = x; row != nullptr && column < width; ++column)
      last[i][static_cast<std::size_t>(column - x)] = row[column];
    return row == nullptr ? nullptr : last[i].data();
  };
  hide_columns({copied(surfaces.nearest, 0), copied(surfaces.reference, 1), copied(surfaces.photographed, 2)},
               tolerance_px, at + static_cast<std::size_t>(x), hiding);
}

/// The columns of a block that are not wholly hidden.
std::uint32_t shown_columns(const float* pixels) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  std::uint32_t shown = 0;
  for (int i = 0; i < HiddenBelow::block_px; i += lanes) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(f, hn::Lt(hn::LoadU(f, pixels + i), hn::Set(f, everything)), bits);
    shown |= static_cast<std::uint32_t>(bits[0] | bits[1] << 8) << i;
  }
  return shown;
}

void find_shown(const DistanceBand& band, int width, HiddenBelow& below) {
  for (int first = 0; first < width; first += HiddenBelow::block_px) {
    std::uint32_t rows = 0;
    for (int row = 0; row < band.row_count; ++row) {
      const std::uint32_t columns =
          shown_columns(below.pixels.data() + static_cast<std::size_t>(row) * band.stride + first);
      below.shown_columns.push_back(static_cast<std::uint16_t>(columns));
      if (columns != 0) rows |= std::uint32_t{1} << row;
    }
    below.shown_rows.push_back(rows);
  }
  below.shown_columns.resize(below.shown_columns.size() + Canvas::widest_vector);
}

/// The largest and the least of each block of columns.
void find_extremes(const DistanceBand& band, int width, HiddenBelow& below) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  for (int first = 0; first < width; first += HiddenBelow::block_px) {
    const int end = std::min(first + HiddenBelow::block_px, width);
    float most = -everything, least = everything;
    if (end - first < HiddenBelow::block_px) {
      for (int row = 0; row < band.row_count; ++row) {
        const float* pixels = below.pixels.data() + static_cast<std::size_t>(row) * band.stride;
        most = std::max(most, *std::max_element(pixels + first, pixels + end));
        least = std::min(least, *std::min_element(pixels + first, pixels + end));
      }
    } else {
      auto high = hn::Set(f, most), low = hn::Set(f, least);
      for (int row = 0; row < band.row_count; ++row) {
        const float* pixels = below.pixels.data() + static_cast<std::size_t>(row) * band.stride;
        for (int x = first; x < end; x += lanes) {
          high = hn::Max(high, hn::LoadU(f, pixels + x));
          low = hn::Min(low, hn::LoadU(f, pixels + x));
        }
      }
      most = hn::GetLane(hn::MaxOfLanes(f, high));
      least = hn::GetLane(hn::MinOfLanes(f, low));
    }
    below.most.push_back(most);
    below.least.push_back(least);
  }
}

void hide_band(const Hiding& hiding, const DistanceBand& band, int width, BandHiding& hides) {
  const ImageView<const float>& photographed = hiding.photographed.empty() ? hiding.reference : hiding.photographed;
  const bool has_others = !hiding.reference.empty();
  std::array<HiddenBelow*, 4> kinds{&hides.own, &hides.other, &hides.continued, &hides.gaps};
  const std::span<HiddenBelow*> hidden = std::span(kinds).first(has_others ? 4 : 1);
  for (HiddenBelow* below : hidden) below->pixels.resize(band.squared.size(), -everything);
  for (int row = 0; row < band.row_count; ++row) {
    const int y = band.top + row - hiding.first_row;
    const SurfacesAt surfaces{hiding.surface.row(y).data(), has_others ? hiding.reference.row(y).data() : nullptr,
                              has_others ? photographed.row(y).data() : nullptr};
    hide_row(surfaces, width, hiding.tolerance_px, static_cast<std::size_t>(row) * band.stride, hides);
  }
  for (HiddenBelow* below : hidden) {
    find_extremes(band, width, *below);
    find_shown(band, width, *below);
  }
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
