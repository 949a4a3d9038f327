#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/rasterise_internal.h"

namespace wheatstone {

void TransmittanceMask::clamp(int row, int& begin, int& end) const {
  int first = begin / FrontToBackAccumulator::block_px;
  int last = (end - 1) / FrontToBackAccumulator::block_px;
  while (first <= last && !is_open(row, first)) ++first;
  while (last > first && !is_open(row, last)) --last;
  begin = std::max(begin, first * FrontToBackAccumulator::block_px);
  end = std::min(end, (last + 1) * FrontToBackAccumulator::block_px);
}

FrontToBackAccumulator::FrontToBackAccumulator(int row_count, int canvas_width)
    : width(canvas_width),
      stride(canvas_width + 2 * Canvas::widest_vector),
      red(static_cast<std::size_t>(row_count) * stride),
      green(red.size()),
      blue(red.size()),
      light(red.size(), 1.f),
      open(row_count, stride / block_px + 1) {
  // Nothing is to be drawn in the padding.
  for (int row = 0; row < row_count; ++row)
    std::fill_n(light.begin() + static_cast<std::ptrdiff_t>(row) * stride + width, stride - width, 0.f);
}

namespace {

/// A pixel that lets more light through has no paint to speak of.
constexpr float least_covered_light = 1 - 1.f / 64;

std::uint8_t rounded(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); }

/// Gives the pixels of a row that nothing covers at all the colour beside them on the farther surface.
void continue_paint(std::span<const float> light, std::span<const float> surface, std::span<Rgb8> row) {
  const int width = static_cast<int>(row.size());
  const auto depth = [&](int x) { return surface.empty() || std::isnan(surface[x]) ? 0 : surface[x]; };
  for (int begin = 0; begin < width; ++begin) {
    if (light[begin] < least_covered_light) continue;
    int end = begin;
    while (end < width && light[end] >= least_covered_light) ++end;
    const bool from_left = end == width || (begin > 0 && depth(begin - 1) <= depth(end));
    if (begin > 0 || end < width) std::fill(row.begin() + begin, row.begin() + end, row[from_left ? begin - 1 : end]);
    begin = end;
  }
}

/// A band of a view, drawn from the nearest stroke to the farthest.
struct DrawnBand {
  const PreparedStrokes& painting;
  const ViewToDraw& view;
  const FrontToBackAccumulator& accumulator;
};

/// Writes a finished row over the background; `offset` is its place in the accumulator.
void finish_row(const DrawnBand& band, std::size_t offset, int y) {
  const PreparedStrokes& painting = band.painting;
  const ViewToDraw& work = band.view;
  const FrontToBackAccumulator& accumulator = band.accumulator;
  const std::span light = std::span(accumulator.light).subspan(offset, accumulator.width);
  const auto to = work.drawn.picture.row(y);
  const auto paint = [&](int x) {
    const std::size_t i = offset + static_cast<std::size_t>(x);
    return std::array{accumulator.red[i], accumulator.green[i], accumulator.blue[i]};
  };
  if (work.background.empty() && !painting.canvas_shows) {
    for (int x = 0; x < painting.width; ++x) {
      const auto [red, green, blue] = paint(x);
      const float whole = 1 / std::max(1 - light[x], 1e-6f);
      to[x] = {rounded(red * whole), rounded(green * whole), rounded(blue * whole)};
    }
    const ImageView<const float> surface = work.hiding.surface;
    continue_paint(light, surface.empty() ? std::span<const float>() : surface.row(y), to);
    return;
  }
  for (int x = 0; x < painting.width; ++x) {
    const auto [red, green, blue] = paint(x);
    const Rgb8 behind = work.background.empty() ? painting.canvas_colour : work.background(x, y);
    to[x] = {rounded(red + light[x] * behind.r), rounded(green + light[x] * behind.g),
             rounded(blue + light[x] * behind.b)};
  }
}

/// Writes a finished band and returns how many of its pixels are bare.
std::size_t finish_band(const DrawnBand& band, int top, int row_count) {
  const FrontToBackAccumulator& accumulator = band.accumulator;
  std::size_t bare = 0;
  for (int row = 0; row < row_count; ++row) {
    const std::size_t offset = static_cast<std::size_t>(row) * accumulator.stride;
    finish_row(band, offset, top + row);
    const auto bare_to = band.view.drawn.bare.row(top + row);
    for (int x = 0; x < accumulator.width; ++x) {
      const bool is_bare = accumulator.light[offset + static_cast<std::size_t>(x)] > band.painting.bare_light;
      bare_to[x] = is_bare ? 255 : 0;
      bare += is_bare ? 1 : 0;
    }
  }
  return bare;
}

/// One band of a painting, drawn for many views: the parts of strokes in it are made once, when a view first needs
/// them.
class BandOfViews {
 public:
  BandOfViews(const PreparedStrokes& painting, int number)
      : painting_(painting),
        number_(static_cast<std::size_t>(number)),
        band_(number * band_rows, painting.width, painting.height),
        scratch_(band_.top, 0, painting.height) {
    for (const BandedLayer& layer : painting.layers) stamps_.emplace_back(layer.bands[number_].size());
  }

  /// Returns how many pixels are bare.
  std::size_t draw(const ViewToDraw& view) {
    const BandHiding hides(view.hiding, band_, painting_.width);
    FrontToBackAccumulator accumulator(band_.row_count, painting_.width);
    draw_strokes(
        view, [&](const FlatStroke& stroke) { return &hides.of(stroke, view.hiding); }, accumulator);
    if (!view.hiding.reference.empty())
      draw_strokes(
          view,
          [&](const FlatStroke& stroke) { return view.hiding.is_own(stroke.reference_view) ? nullptr : &hides.gaps; },
          accumulator);
    return finish_band({painting_, view, accumulator}, band_.top, band_.row_count);
  }

 private:
  /// `hidden_below(stroke)` tells what hides it; null: it is not drawn.
  template <class HiddenBelowOf>
  void draw_strokes(const ViewToDraw& view, HiddenBelowOf hidden_below, FrontToBackAccumulator& accumulator) {
    for (std::size_t above = painting_.layers.size(); above-- > 0;) {
      const FlatLayer& layer = painting_.layers[above].flat;
      const std::vector<std::uint32_t>& strokes = painting_.layers[above].bands[number_];
      const SeenLayer seen(layer, view.position);
      for (std::size_t nearer = strokes.size(); nearer-- > 0;) {
        const FlatStroke& stroke = layer.strokes[strokes[nearer]];
        if (!stroke.views.contains(view.position)) continue;
        const HiddenBelow* const below = hidden_below(stroke);
        if (below == nullptr) continue;
        if (!stroke.is_rigid) {
          draw_stroke_under({seen, stroke, *below}, band_, accumulator);
        } else if (const StampPlace place = place_of(stroke, seen.shift); is_open(place, accumulator)) {
          const Stamp& stamp = stamp_of(layer, stroke, stamps_[above][nearer]);
          lay_stamp_under({stamp, values_.data() + stamp.first_value, stroke, *below, seen.shift, band_.top,
                           may_be_hidden(place, *below)},
                          accumulator);
        }
      }
    }
  }

  /// Where a stamp may lie in a view: rows of the band, and columns.
  struct StampPlace {
    int first_row, end_row, begin, end;
    float farthest_disparity;
  };

  StampPlace place_of(const FlatStroke& stroke, float view) const {
    const float reach = BrushProfile(stroke.radius_px).reach_px + 1;
    const float top = stroke.disparity + stroke.depth_slope * (stroke.top - reach),
                bottom = stroke.disparity + stroke.depth_slope * (stroke.bottom + reach);
    const auto [least, most] = std::minmax({view * top, view * bottom});
    return {std::max(static_cast<int>(stroke.top - reach) - band_.top, 0),
            std::min(static_cast<int>(stroke.bottom + reach) - band_.top + 1, band_.row_count),
            std::max(static_cast<int>(stroke.left - reach - most), 0),
            std::min(static_cast<int>(stroke.right + reach - least) + 1, painting_.width), std::min(top, bottom)};
  }

  /// Whether light comes through anywhere in a place.
  static bool is_open(const StampPlace& place, const FrontToBackAccumulator& accumulator) {
    if (place.begin >= place.end) return false;
    constexpr int block_px = FrontToBackAccumulator::block_px;
    for (int row = place.first_row; row < place.end_row; ++row)
      if (accumulator.open.is_any_open(row, place.begin / block_px, (place.end - 1) / block_px)) return true;
    return false;
  }

  static bool may_be_hidden(const StampPlace& place, const HiddenBelow& below) {
    if (below.pixels.empty()) return false;
    for (int block = place.begin / HiddenBelow::block_px; block * HiddenBelow::block_px < place.end; ++block)
      if (place.farthest_disparity < below.blocks[static_cast<std::size_t>(block)]) return true;
    return false;
  }

  const Stamp& stamp_of(const FlatLayer& layer, const FlatStroke& stroke, Stamp& stamp) {
    if (stamp.width > 0) return stamp;
    const float reach = BrushProfile(stroke.radius_px).reach_px;
    stamp.left = static_cast<int>(std::floor(stroke.left - reach));
    stamp.width = static_cast<int>(std::ceil(stroke.right + reach)) - stamp.left + 1;
    if (scratch_.stride < stamp.width + 2 * Canvas::widest_vector)
      scratch_ = DistanceBand(band_.top, stamp.width, painting_.height);
    make_stamp({SeenLayer(layer, central_view, stamp.left), stroke, nothing_hides_}, scratch_, stamp, values_);
    return stamp;
  }

  const PreparedStrokes& painting_;
  std::size_t number_;
  DistanceBand band_;
  DistanceBand scratch_;  ///< as wide as the widest stamp so far
  HiddenBelow nothing_hides_;
  std::vector<std::vector<Stamp>> stamps_;  ///< of each layer, of the strokes in this band
  std::vector<std::uint16_t> values_;
};

/// One stroke that covers half a pixel leaves this much light. Strokes that are fading do not say how opaque the paint
/// is.
float bare_light_of(const StrokePainting& painting) {
  float opacity = 0;
  for (const Layer& layer : painting.layers)
    for (const Stroke& stroke : layer.strokes) opacity = std::max(opacity, stroke.opacity);
  return 1 - (opacity > 0 ? opacity : 1) / 2;
}

}  // namespace

PreparedStrokes prepare_marks(const StrokePainting& painting) {
  PreparedStrokes prepared{painting.width,          painting.height,
                           painting.canvas_colour,  std::vector<BandedLayer>(painting.layers.size()),
                           bare_light_of(painting), painting.canvas_shows};
  tbb::parallel_for(std::size_t{0}, prepared.layers.size(), [&](std::size_t i) {
    BandedLayer& layer = prepared.layers[i];
    layer.flat = flatten(painting.layers[i]);
    layer.bands = strokes_by_band(layer.flat, painting.height);
  });
  return prepared;
}

void draw_marks(const PreparedStrokes& painting, std::span<const ViewToDraw> views) {
  for (const ViewToDraw& view : views) {
    assert(view.background.empty() ||
           (view.background.width() == painting.width && view.background.height() == painting.height));
    view.drawn.picture = Image<Rgb8>(painting.width, painting.height);
    view.drawn.bare = Image<std::uint8_t>(painting.width, painting.height);
  }
  const int bands = (painting.height + band_rows - 1) / band_rows;
  std::vector<std::vector<std::size_t>> bare(static_cast<std::size_t>(bands), std::vector<std::size_t>(views.size()));
  tbb::parallel_for(0, bands, [&](int i) {
    BandOfViews band(painting, i);
    for (std::size_t v = 0; v < views.size(); ++v) bare[static_cast<std::size_t>(i)][v] = band.draw(views[v]);
  });
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::size_t bare_pixels = 0;
    for (const std::vector<std::size_t>& of_band : bare) bare_pixels += of_band[v];
    views[v].drawn.bare_share =
        static_cast<double>(bare_pixels) / (static_cast<double>(painting.width) * painting.height);
  }
}

}  // namespace wheatstone
