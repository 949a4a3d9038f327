#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/prepared_painting_internal.h"

namespace wheatstone {
namespace {

using Contents = PreparedPainting::Contents;

/// The strokes of a painting whose views can be drawn band by band; none where they cannot.
const PreparedStrokes* strokes_in_bands(const Contents& contents) {
  const bool has_bands = contents.on_gpu == nullptr && contents.relief.depth_px <= 0;
  return has_bands ? std::get_if<PreparedStrokes>(&contents.marks) : nullptr;
}

/// Whether all is the same but strokes and what hides them.
bool is_alike(const PreparedStrokes& one, const PreparedStrokes& other) {
  return one.width == other.width && one.height == other.height && one.canvas_colour == other.canvas_colour &&
         one.bare_light == other.bare_light && one.canvas_shows == other.canvas_shows &&
         std::ranges::equal(one.layers, other.layers, {}, &BandedLayer::brush, &BandedLayer::brush);
}

bool is_alike(const Surfaces& one, const Surfaces& other) {
  const auto alike = [](const Surface& a, const Surface& b) {
    return a.view == b.view && a.left_px == b.left_px && a.continued == b.continued &&
           a.disparity.width() == b.disparity.width() && a.disparity.height() == b.disparity.height();
  };
  return one.tolerance_px == other.tolerance_px && std::ranges::equal(one.seen, other.seen, alike);
}

bool is_same(const FlatLayer& layer, FlatStroke stroke, const FlatLayer& other_layer, const FlatStroke& other) {
  const std::size_t first = std::exchange(stroke.first_vertex, other.first_vertex);
  if (stroke != other) return false;
  const auto same = [&](std::vector<float> FlatLayer::*values) {
    return std::ranges::equal(std::span(layer.*values).subspan(first, stroke.vertex_count),
                              std::span(other_layer.*values).subspan(other.first_vertex, other.vertex_count));
  };
  return same(&FlatLayer::x) && same(&FlatLayer::y) && same(&FlatLayer::disparity) && same(&FlatLayer::along);
}

bool is_same_band(const BandedLayer& one, const BandedLayer& other, std::size_t band) {
  return std::ranges::equal(one.bands[band], other.bands[band], [&](std::uint32_t a, std::uint32_t b) {
    return is_same(one.flat, one.flat.strokes[a], other.flat, other.flat.strokes[b]);
  });
}

bool is_same_row(const KnownRuns& one, const KnownRuns& other, int y) {
  return std::ranges::equal(one.runs_of(y), other.runs_of(y), [&](const KnownRuns::Run& a, const KnownRuns::Run& b) {
    return a.begin == b.begin && a.end == b.end && std::ranges::equal(one.values_of(a), other.values_of(b));
  });
}

/// The bands in which strokes differ, or surfaces that hide them.
std::vector<int> differing_bands(const PreparedStrokes& one, const Surfaces& one_surfaces, const PreparedStrokes& other,
                                 const Surfaces& other_surfaces) {
  std::vector<std::uint8_t> differs(static_cast<std::size_t>(band_count(one.height)));
  tbb::parallel_for(std::size_t{0}, differs.size(), [&](std::size_t band) {
    for (std::size_t i = 0; i < one.layers.size() && differs[band] == 0; ++i)
      differs[band] = is_same_band(one.layers[i], other.layers[i], band) ? 0 : 1;
    const int first = static_cast<int>(band) * band_rows, end = std::min(first + band_rows, one.height);
    for (std::size_t i = 0; i < one_surfaces.seen.size(); ++i) {
      const KnownRuns &disparity = one_surfaces.seen[i].disparity, &other_disparity = other_surfaces.seen[i].disparity;
      for (int y = first; y < std::min(end, disparity.height()) && differs[band] == 0; ++y)
        differs[band] = is_same_row(disparity, other_disparity, y) ? 0 : 1;
    }
  });
  std::vector<int> bands;
  for (std::size_t band = 0; band < differs.size(); ++band)
    if (differs[band] != 0) bands.push_back(static_cast<int>(band));
  return bands;
}

}  // namespace

void draw_again(const PreparedPainting& painting, const PreparedPainting& before, std::span<const ViewPosition> views,
                std::span<Image<Rgb8>> pictures) {
  const Contents &now = painting.contents(), &then = before.contents();
  const PreparedStrokes *const strokes = strokes_in_bands(now), *const strokes_then = strokes_in_bands(then);
  std::vector<DrawnView> drawn;
  if (strokes == nullptr || strokes_then == nullptr || !is_alike(*strokes, *strokes_then) ||
      !is_alike(now.surfaces, then.surfaces)) {
    drawn = draw(painting, views);
  } else {
    std::vector<ViewToDraw> to_draw;
    drawn.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
      drawn[i].picture = std::move(pictures[i]);
      drawn[i].bare = Image<std::uint8_t>(now.width, now.height);
      to_draw.push_back({views[i], {}, drawn[i]});
    }
    draw_bands(*strokes, now.surfaces, to_draw, differing_bands(*strokes, now.surfaces, *strokes_then, then.surfaces));
  }
  for (std::size_t i = 0; i < views.size(); ++i) pictures[i] = std::move(drawn[i].picture);
}

}  // namespace wheatstone
