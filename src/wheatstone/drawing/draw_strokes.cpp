#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "wheatstone/drawing/draw.h"
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

FrontToBackAccumulator::FrontToBackAccumulator(int row_count, int canvas_width, bool with_disparity)
    : width(canvas_width),
      stride(canvas_width + 2 * Canvas::widest_vector),
      red(static_cast<std::size_t>(row_count) * stride),
      green(red.size()),
      blue(red.size()),
      light(red.size(), 1.f),
      disparity(with_disparity ? red.size() : 0, std::numeric_limits<float>::quiet_NaN()),
      open(row_count, stride / block_px + 1) {
  // Nothing is to be drawn in the padding.
  for (int row = 0; row < row_count; ++row)
    std::fill_n(light.begin() + static_cast<std::ptrdiff_t>(row) * stride + width, stride - width, 0.f);
}

namespace {

/// A layer, flattened for one view and sorted into bands.
struct BandedLayer {
  FlatLayer flat;
  std::vector<std::vector<std::uint32_t>> bands;
};

/// The colour behind a pixel of the painting.
class Backdrop {
 public:
  Backdrop(Rgb8 colour, ImageView<const Rgb8> picture) : colour_(colour), picture_(picture) {}
  Rgb8 operator()(int x, int y) const { return picture_.empty() ? colour_ : picture_(x, y); }

 private:
  Rgb8 colour_;
  ImageView<const Rgb8> picture_;
};

/// Writes a finished band and returns how many of its pixels let more light through than `bare_light`.
std::size_t finish_band(const FrontToBackAccumulator& accumulator, const DistanceBand& band, const Backdrop& backdrop,
                        float bare_light, DrawnView& drawn) {
  std::size_t bare = 0;
  const auto rounded = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
  for (int row = 0; row < band.row_count; ++row) {
    const std::size_t offset = static_cast<std::size_t>(row) * accumulator.stride;
    const auto to = drawn.picture.row(band.top + row);
    const auto bare_to = drawn.bare.row(band.top + row);
    if (!drawn.disparity.empty())
      std::copy_n(accumulator.disparity.begin() + static_cast<std::ptrdiff_t>(offset), accumulator.width,
                  drawn.disparity.row(band.top + row).begin());
    for (int x = 0; x < accumulator.width; ++x) {
      const std::size_t i = offset + static_cast<std::size_t>(x);
      const float light = accumulator.light[i];
      const Rgb8 behind = backdrop(x, band.top + row);
      to[x] = {rounded(accumulator.red[i] + light * behind.r), rounded(accumulator.green[i] + light * behind.g),
               rounded(accumulator.blue[i] + light * behind.b)};
      const bool is_bare = light > bare_light;
      bare_to[x] = is_bare ? 255 : 0;
      bare += is_bare ? 1 : 0;
    }
  }
  return bare;
}

/// One stroke that covers half a pixel leaves this much light. Strokes that are fading do not say how opaque the paint
/// is.
float bare_light_of(const StrokePainting& painting) {
  float opacity = 0;
  for (const Layer& layer : painting.layers)
    for (const Stroke& stroke : layer.strokes) opacity = std::max(opacity, stroke.opacity);
  return 1 - (opacity > 0 ? opacity : 1) / 2;
}

}  // namespace

DrawnView draw(const StrokePainting& painting, ViewPosition view, const DrawOptions& options) {
  const ImageView<const Rgb8> background = options.background;
  assert(background.empty() || (background.width() == painting.width && background.height() == painting.height));
  std::vector<BandedLayer> layers(painting.layers.size());
  tbb::parallel_for(std::size_t{0}, layers.size(), [&](std::size_t i) {
    layers[i].flat = flatten(painting.layers[i], view);
    layers[i].bands = strokes_by_band(layers[i].flat, painting.height);
  });

  DrawnView drawn{Image<Rgb8>(painting.width, painting.height), 0, Image<std::uint8_t>(painting.width, painting.height),
                  Image<float>()};
  if (options.with_disparity) drawn.disparity = Image<float>(painting.width, painting.height);
  const Backdrop backdrop(painting.canvas_colour, background);
  const float bare_light = bare_light_of(painting);
  const int bands = (painting.height + band_rows - 1) / band_rows;
  std::vector<std::size_t> bare(bands);
  tbb::parallel_for(0, bands, [&](int i) {
    DistanceBand band(i * band_rows, painting.width, painting.height);
    FrontToBackAccumulator accumulator(band.row_count, painting.width, options.with_disparity);
    for (std::size_t above = layers.size(); above-- > 0;) {
      const BandedLayer& layer = layers[above];
      const std::vector<std::uint32_t>& strokes = layer.bands[i];
      for (std::size_t nearer = strokes.size(); nearer-- > 0;)
        draw_stroke_under(layer.flat, layer.flat.strokes[strokes[nearer]], band, accumulator);
    }
    bare[i] = finish_band(accumulator, band, backdrop, bare_light, drawn);
  });
  std::size_t bare_pixels = 0;
  for (const std::size_t count : bare) bare_pixels += count;
  drawn.bare_share = static_cast<double>(bare_pixels) / (static_cast<double>(painting.width) * painting.height);
  return drawn;
}

}  // namespace wheatstone
