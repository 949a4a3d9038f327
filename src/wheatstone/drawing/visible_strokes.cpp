#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "wheatstone/drawing/hidden_strokes.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/drawing/visible_strokes_internal.h"

namespace wheatstone {
namespace {

/// The light that comes through a rectangle of a band, before a stroke is drawn under what is there.
class LightBefore {
 public:
  void keep(const SeenLayer& layer, const FlatStroke& stroke, const DistanceBand& band,
            const FrontToBackAccumulator& accumulator) {
    const float reach = BrushProfile(stroke.radius_px).reach_px + 1;
    float left = layer.x(stroke.first_vertex), right = left;
    for (std::uint32_t i = 1; i < stroke.vertex_count; ++i) {
      left = std::min(left, layer.x(stroke.first_vertex + i));
      right = std::max(right, layer.x(stroke.first_vertex + i));
    }
    const auto clamped = [](float place, int most) {
      return static_cast<int>(std::clamp(std::floor(place), 0.f, static_cast<float>(most)));
    };
    const auto top = static_cast<float>(band.top);
    first_row_ = clamped(stroke.top - reach - top, band.row_count);
    end_row_ = clamped(stroke.bottom + reach + 1 - top, band.row_count);
    begin_ = clamped(left - reach, accumulator.width());
    end_ = clamped(right + reach + 1, accumulator.width());
    light_.clear();
    for (int row = first_row_; row < end_row_; ++row) {
      for (int x = begin_; x < end_; ++x) light_.push_back(accumulator.light(row, x));
    }
  }

  /// The largest share of a pixel's light that has been taken since.
  float largest_share_taken(const FrontToBackAccumulator& accumulator) const {
    float largest = 0;
    const float* before = light_.data();
    for (int row = first_row_; row < end_row_; ++row) {
      for (int x = begin_; x < end_; ++x) largest = std::max(largest, *before++ - accumulator.light(row, x));
    }
    return largest;
  }

 private:
  int first_row_ = 0, end_row_ = 0, begin_ = 0, end_ = 0;
  std::vector<float> light_;
};

}  // namespace

void mark_visible(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding, float least_share,
                  std::span<std::vector<std::uint8_t>> visible) {
  std::vector<SeenLayer> layers;
  for (const BandedLayer& layer : painting.layers) layers.emplace_back(layer.flat, view);
  const int bands = (painting.height + band_rows - 1) / band_rows;
  tbb::parallel_for(0, bands, [&](int i) {
    DistanceBand band(i * band_rows, painting.width, painting.height);
    const BandHiding hides(hiding, band, painting.width);
    FrontToBackAccumulator accumulator(band.row_count, painting.width);
    LightBefore before;
    const auto look_at_strokes = [&](auto hidden_below) {
      for (std::size_t above = layers.size(); above-- > 0;) {
        const std::vector<std::uint32_t>& strokes = painting.layers[above].bands[i];
        for (std::size_t nearer = strokes.size(); nearer-- > 0;) {
          const FlatStroke& stroke = layers[above].flat.strokes[strokes[nearer]];
          if (!stroke.views.contains(view)) continue;
          const HiddenBelow* const below = hidden_below(stroke);
          if (below == nullptr) continue;
          // A stroke that lies in several bands is marked by whichever sees it.
          const std::atomic_ref is_visible(visible[above][strokes[nearer]]);
          const bool is_known = is_visible.load(std::memory_order_relaxed) != 0;
          if (!is_known) before.keep(layers[above], stroke, band, accumulator);
          draw_stroke_under({layers[above], stroke, *below, painting.layers[above].brush}, band, accumulator);
          if (!is_known && before.largest_share_taken(accumulator) > least_share)
            is_visible.store(1, std::memory_order_relaxed);
        }
      }
    };
    look_at_strokes([&](const FlatStroke& stroke) { return &hides.of(stroke, hiding); });
    if (!hiding.reference.empty())
      look_at_strokes(
          [&](const FlatStroke& stroke) { return hiding.is_own(stroke.reference_view) ? nullptr : &hides.gaps; });
  });
}

std::vector<std::vector<std::uint8_t>> visible_strokes(const PreparedStrokes& painting, ViewPosition view,
                                                       const Hiding& hiding, float least_share) {
  std::vector<std::vector<std::uint8_t>> visible;
  for (const BandedLayer& layer : painting.layers) visible.emplace_back(layer.flat.strokes.size(), std::uint8_t{0});
  mark_visible(painting, view, hiding, least_share, visible);
  return visible;
}

StrokePainting without_hidden_strokes(const StrokePainting& painting, const Surfaces& surfaces,
                                      std::span<const ViewPosition> views, float least_share) {
  std::vector<std::vector<std::uint8_t>> shown;
  for (const Layer& layer : painting.layers) shown.emplace_back(layer.strokes.size(), std::uint8_t{0});
  PreparedStrokes of_one_layer = prepare_marks(painting);
  std::vector<BandedLayer> layers(1);
  std::swap(layers, of_one_layer.layers);
  for (const ViewPosition view : views) {
    const SeenSurfaces seen = seen_surfaces(surfaces, view, {painting.width, 0, painting.height});
    for (std::size_t i = 0; i < painting.layers.size(); ++i) {
      std::swap(layers[i], of_one_layer.layers.front());
      mark_visible(of_one_layer, view, seen.hiding, least_share, std::span(&shown[i], 1));
      std::swap(layers[i], of_one_layer.layers.front());
    }
  }
  StrokePainting kept = painting;
  for (std::size_t i = 0; i < kept.layers.size(); ++i) {
    std::vector<Stroke>& strokes = kept.layers[i].strokes;
    number_by_place(kept.layers[i]);
    std::size_t place = 0;
    std::erase_if(strokes, [&](const Stroke&) { return shown[i][place++] == 0; });
  }
  return kept;
}

}  // namespace wheatstone
