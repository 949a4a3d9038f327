#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/drawing/visible_strokes_internal.h"

namespace wheatstone {
namespace {

/// The light that comes through a rectangle of a band, before a stroke is drawn under what is there.
class LightBefore {
 public:
  void keep(const FlatLayer& layer, const FlatStroke& stroke, const DistanceBand& band,
            const FrontToBackAccumulator& accumulator) {
    const float reach = BrushProfile(stroke.radius_px).reach_px + 1;
    const auto [left, right] = std::minmax_element(layer.x.begin() + stroke.first_vertex,
                                                   layer.x.begin() + stroke.first_vertex + stroke.vertex_count);
    const auto clamped = [](float place, int most) {
      return static_cast<int>(std::clamp(std::floor(place), 0.f, static_cast<float>(most)));
    };
    const auto top = static_cast<float>(band.top);
    first_row_ = clamped(stroke.top - reach - top, band.row_count);
    end_row_ = clamped(stroke.bottom + reach + 1 - top, band.row_count);
    begin_ = clamped(*left - reach, accumulator.width);
    end_ = clamped(*right + reach + 1, accumulator.width);
    light_.clear();
    for (int row = first_row_; row < end_row_; ++row) {
      const float* from = accumulator.light.data() + static_cast<std::size_t>(row) * accumulator.stride;
      light_.insert(light_.end(), from + begin_, from + end_);
    }
  }

  /// The largest share of a pixel's light that has been taken since.
  float largest_share_taken(const FrontToBackAccumulator& accumulator) const {
    float largest = 0;
    const float* before = light_.data();
    for (int row = first_row_; row < end_row_; ++row) {
      const float* now = accumulator.light.data() + static_cast<std::size_t>(row) * accumulator.stride;
      for (int x = begin_; x < end_; ++x) largest = std::max(largest, *before++ - now[x]);
    }
    return largest;
  }

 private:
  int first_row_ = 0, end_row_ = 0, begin_ = 0, end_ = 0;
  std::vector<float> light_;
};

}  // namespace

std::vector<std::vector<std::uint8_t>> visible_strokes(const StrokePainting& painting, ViewPosition view,
                                                       float least_share) {
  std::vector<FlatLayer> layers;
  std::vector<std::vector<std::vector<std::uint32_t>>> bands_of;
  std::vector<std::vector<std::uint8_t>> visible;
  for (const Layer& layer : painting.layers) {
    layers.push_back(flatten(layer, view));
    bands_of.push_back(strokes_by_band(layers.back(), painting.height));
    visible.emplace_back(layers.back().strokes.size(), std::uint8_t{0});
  }
  const int bands = (painting.height + band_rows - 1) / band_rows;
  tbb::parallel_for(0, bands, [&](int i) {
    DistanceBand band(i * band_rows, painting.width, painting.height);
    FrontToBackAccumulator accumulator(band.row_count, painting.width);
    LightBefore before;
    for (std::size_t above = layers.size(); above-- > 0;) {
      const FlatLayer& layer = layers[above];
      const std::vector<std::uint32_t>& strokes = bands_of[above][i];
      for (std::size_t nearer = strokes.size(); nearer-- > 0;) {
        const FlatStroke& stroke = layer.strokes[strokes[nearer]];
        before.keep(layer, stroke, band, accumulator);
        draw_stroke_under(layer, stroke, band, accumulator);
        // A stroke that lies in several bands is marked by whichever sees it.
        if (before.largest_share_taken(accumulator) > least_share)
          std::atomic_ref(visible[above][strokes[nearer]]).store(1, std::memory_order_relaxed);
      }
    }
  });
  return visible;
}

}  // namespace wheatstone
