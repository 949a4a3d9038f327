#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "continue_paint_source.h"
#include "draw_strokes_source.h"
#include "want_rows_source.h"
#include "wheatstone/drawing/painting_gpu_internal.h"

namespace wheatstone {
namespace {

constexpr int tile_px = 8, cell_px = 16;
constexpr int wanted_tile_px = 32;  ///< columns of a tile of which not all pixels are wanted
constexpr std::uint32_t highest_bit = std::uint32_t{1} << 31;

/// Parameters of draw_strokes.comp: numbers of four bytes, without gaps.
struct StrokeWork {
  std::int32_t width = 0, height = 0;
  std::int32_t has_surfaces = 0, shows_behind = 0, has_background = 0, only_wanted = 0;
  std::uint32_t canvas = 0;
  float bare_light = 0, tolerance_px = 0;
  float still_depth = 0;
  std::int32_t first_cell = 0;
  std::uint32_t cells_a_band = 0;
  float streaks = 0, ridge = 0;
  std::array<float, most_gpu_views> view{};
};

using Segment = StrokesForGpu::Segment;

StrokesForGpu::Stroke stroke_for_gpu(const FlatStroke& stroke, PlannedIn planned_in) {
  const BrushProfile brush(stroke.radius_px);
  return {stroke.red,
          stroke.green,
          stroke.blue,
          stroke.opacity,
          brush.middle_px,
          brush.rim_px,
          stroke.views.first - central_view,
          stroke.views.last - central_view,
          static_cast<std::int32_t>(planned_in)};
}

/// What varies within strokes: PAINT of draw_strokes.comp.
enum class PaintInStrokes { even, changes, bristles };

PaintInStrokes paint_of(const PreparedStrokes& painting) {
  PaintInStrokes paint = PaintInStrokes::even;
  for (const BandedLayer& layer : painting.layers) {
    if (layer.brush.varies()) return PaintInStrokes::bristles;
    if (std::ranges::any_of(layer.flat.strokes, &FlatStroke::changes_colour)) paint = PaintInStrokes::changes;
  }
  return paint;
}

/// The brush of all layers, as the nearest has it.
Brush brush_of(const PreparedStrokes& painting) {
  return painting.layers.empty() ? Brush{} : painting.layers.back().brush;
}

/// The bytes of its picture, and as many more as make whole texels.
std::vector<std::uint8_t> picture_of(const PreparedStrokes& painting) {
  constexpr std::size_t texel_bytes = 16;
  std::vector<std::uint8_t> bytes = brush_of(painting).picture.levels;
  bytes.resize((bytes.size() + texel_bytes - 1) / texel_bytes * texel_bytes);
  return bytes;
}

/// As class Bristles in bristles_simd_internal.h has it.
StrokesForGpu::Bristles bristles_for_gpu(const FlatStroke& stroke, const Brush& brush) {
  const bool is_long = stroke.length > 2 * stroke.radius_px;
  const float width_px = streak_width_px(brush.bristle_px, stroke.radius_px);
  return {stroke.red_change,
          stroke.green_change,
          stroke.blue_change,
          std::max(stroke.length, 1e-3f),
          stroke.radius_px,
          is_long && !brush.picture.empty() ? -width_px : width_px,
          is_long ? brush.dry * stroke.length : 0,
          stroke.seed};
}

/// The places of a segment from one vertex to another, as PlacesOfSegment in distances_simd.cpp.
StrokesForGpu::PlacesOfSegment places_of(const FlatLayer& layer, const FlatStroke& stroke, std::uint32_t from,
                                         std::uint32_t to) {
  constexpr float ends = 1e6f;  // the first and the last segment go on
  return {layer.along[from], layer.along[to] - layer.along[from], from == stroke.first_vertex ? -ends : 0,
          to == stroke.first_vertex + stroke.vertex_count - 1 ? ends : 1};
}

/// The segment from one vertex to another. `number`: the stroke's.
Segment segment_of(const FlatLayer& layer, const FlatStroke& stroke, std::uint32_t from, std::uint32_t to,
                   std::uint32_t number) {
  Segment segment{layer.x[from],
                  layer.y[from],
                  layer.x[to] - layer.x[from],
                  layer.y[to] - layer.y[from],
                  layer.disparity[from],
                  layer.disparity[to] - layer.disparity[from],
                  BrushProfile(stroke.radius_px).reach_px,
                  number};
  if (!stroke.is_rigid) return segment;
  segment.depth = stroke.disparity;
  segment.depth_slope = stroke.depth_slope;
  segment.stroke |= highest_bit;
  return segment;
}

struct Depths {
  float farthest, nearest;
};

/// The range of disparities that a segment paints.
Depths depths_of(const Segment& segment) {
  if ((segment.stroke & highest_bit) == 0) {
    const auto [farthest, nearest] = std::minmax({segment.depth, segment.depth + segment.depth_slope});
    return {farthest, nearest};
  }
  const auto [top, bottom] = std::minmax({segment.y, segment.y + segment.dy});
  const auto [farthest, nearest] = std::minmax({segment.depth + segment.depth_slope * (top - segment.reach),
                                                segment.depth + segment.depth_slope * (bottom + segment.reach)});
  return {farthest, nearest};
}

/// The middle of all depths.
float still_depth_of(std::span<const Segment> segments) {
  Depths all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (const Segment& segment : segments) {
    const Depths depths = depths_of(segment);
    all = {std::min(all.farthest, depths.farthest), std::max(all.nearest, depths.nearest)};
  }
  return segments.empty() ? 0 : (all.farthest + all.nearest) / 2;
}

}  // namespace

StrokesForGpu::StrokesForGpu(const PreparedStrokes& painting, const Surfaces& surfaces) {
  const bool varies = paint_of(painting) != PaintInStrokes::even;
  for_strokes_from_nearest(painting, [&](const BandedLayer& layer, std::size_t place) {
    const FlatStroke& stroke = layer.flat.strokes[place];
    const auto number = static_cast<std::uint32_t>(strokes.size());
    strokes.push_back(stroke_for_gpu(stroke, kind_of(stroke.reference_view, surfaces)));
    if (varies) bristles.push_back(bristles_for_gpu(stroke, layer.brush));
    for_segments(stroke, [&](std::uint32_t from, std::uint32_t to) {
      segments.push_back(segment_of(layer.flat, stroke, from, to, number));
      if (varies) places.push_back(places_of(layer.flat, stroke, from, to));
    });
  });
  still_depth = still_depth_of(segments);
}

CellsForGpu::CellsForGpu(const StrokesForGpu& of, int width, int height, float farthest_view, int tile_columns)
    : first_cell(static_cast<std::int32_t>(std::floor(-farthest_view * std::abs(of.still_depth) / cell_px))) {
  const auto last_cell = static_cast<std::int32_t>(
      std::floor((static_cast<float>(width) + farthest_view * std::abs(of.still_depth)) / cell_px));
  cells_a_band = static_cast<std::uint32_t>(last_cell - first_cell + 1);
  const int bands = (height + tile_px - 1) / tile_px;
  const auto clamped = [](float place, int size, int least, int most) {
    return static_cast<int>(
        std::clamp(std::floor(place / static_cast<float>(size)), static_cast<float>(least), static_cast<float>(most)));
  };
  // Calls `use` with each cell in which a segment may be seen.
  const auto for_cells = [&](const Segment& segment, auto use) {
    const auto [top, bottom] = std::minmax({segment.y, segment.y + segment.dy});
    if (bottom + segment.reach < 0) return;
    const int first_band = clamped(top - segment.reach, tile_px, 0, bands),
              end_band = clamped(bottom + segment.reach, tile_px, -1, bands - 1) + 1;
    const Depths depths = depths_of(segment);
    const float moves =
        farthest_view * std::max(std::abs(depths.farthest - of.still_depth), std::abs(depths.nearest - of.still_depth));
    const auto [left, right] = std::minmax({segment.x, segment.x + segment.dx});
    // A tile's list is that of the cell in which it begins.
    const int first = clamped(left - segment.reach - moves - static_cast<float>(tile_columns), cell_px, first_cell,
                              last_cell),
              end = clamped(right + segment.reach + moves, cell_px, first_cell - 1, last_cell) + 1;
    for (int band = first_band; band < end_band; ++band)
      for (int cell = first; cell < end; ++cell)
        use(static_cast<std::size_t>(band) * cells_a_band + static_cast<std::size_t>(cell - first_cell));
  };
  const auto is_of_reference = [&](const Segment& segment) {
    return of.strokes[segment.stroke & ~highest_bit].planned_in == static_cast<std::int32_t>(PlannedIn::reference_view);
  };
  cell_first.assign(static_cast<std::size_t>(bands) * cells_a_band + 1, 0);
  for (const Segment& segment : of.segments)
    for_cells(segment, [&](std::size_t cell) { cell_first[cell + 1] += is_of_reference(segment) ? 1 : 2; });
  std::partial_sum(cell_first.begin(), cell_first.end(), cell_first.begin());
  in_cells.resize(cell_first.back());
  std::vector<std::uint32_t> next(cell_first.begin(), cell_first.end() - 1);
  for (const bool again : {false, true})
    for (std::uint32_t i = 0; i < of.segments.size(); ++i)
      if (!again || !is_of_reference(of.segments[i]))
        for_cells(of.segments[i], [&](std::size_t cell) { in_cells[next[cell]++] = again ? i | highest_bit : i; });
}

GpuStrokes::GpuStrokes(const PreparedStrokes& painting, const Surfaces& surfaces, const Relief& relief)
    : painting_(painting),
      flat_(painting, surfaces),
      draw_strokes_(draw_strokes_source, {{"PAINT", static_cast<int>(paint_of(painting))}}),
      continue_paint_(continue_paint_source),
      want_rows_(want_rows_source),
      strokes_(std::span<const StrokesForGpu::Stroke>(flat_.strokes)),
      segments_(std::span<const Segment>(flat_.segments)),
      bristles_(std::span<const StrokesForGpu::Bristles>(flat_.bristles)),
      places_(std::span<const StrokesForGpu::PlacesOfSegment>(flat_.places)),
      brush_picture_(std::span<const std::uint8_t>(picture_of(painting))) {
  if (relief.depth_px > 0) relief_.emplace(painting, surfaces, relief);
}

void GpuStrokes::fill_cells(std::span<const ViewPosition> views, int tile_columns) {
  float farthest = 0;
  for (const ViewPosition view : views) farthest = std::max(farthest, std::abs(view - central_view));
  if (cells_ && farthest <= cells_->farthest_view && tile_columns == cells_->tile_columns) return;
  const CellsForGpu cells(flat_, painting_.width, painting_.height, farthest, tile_columns);
  cells_.emplace(CellsOnGpu{tile_columns, farthest, flat_.still_depth, cells.first_cell, cells.cells_a_band,
                            GpuBuffer(std::span<const std::uint32_t>(cells.cell_first)),
                            GpuBuffer(std::span<const std::uint32_t>(cells.in_cells))});
}

GpuBuffer GpuStrokes::draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) {
  const bool only_wanted = views.wanted && views.backgrounds.empty() && !relief_;
  fill_cells(views.positions, only_wanted ? wanted_tile_px : tile_px);
  const auto size = static_cast<std::size_t>(painting_.width) * static_cast<std::size_t>(painting_.height);
  const bool has_background = !views.backgrounds.empty();
  const StrokeWork work{
      .width = painting_.width,
      .height = painting_.height,
      .has_surfaces = surfaces.empty() ? 0 : 1,
      .shows_behind = has_background || painting_.canvas_shows ? 1 : 0,
      .has_background = has_background ? 1 : 0,
      .only_wanted = only_wanted ? 1 : 0,
      .canvas = packed(painting_.canvas_colour),
      .bare_light = painting_.bare_light,
      .tolerance_px = surfaces.tolerance_px(),
      .still_depth = flat_.still_depth,
      .first_cell = cells_->first_cell,
      .cells_a_band = cells_->cells_a_band,
      .streaks = brush_of(painting_).streaks,
      .ridge = brush_of(painting_).ridge,
      .view = gpu_views(views.positions),
  };
  const GpuBuffer of_work(std::span<const StrokeWork>(&work, 1));
  const GpuBuffer behind{std::span<const std::uint32_t>(views.backgrounds)};
  GpuBuffer pixels(size * views.positions.size() * sizeof(std::uint32_t));
  const auto count = static_cast<std::uint32_t>(views.positions.size());
  const std::uint32_t groups_a_band = only_wanted
                                          ? wanted_tile_px / tile_px * groups_of(painting_.width, wanted_tile_px)
                                          : groups_of(painting_.width, tile_px);
  const auto draw_pixels = [&](const GpuBuffer& behind_or_wanted) {
    draw_strokes_.run(
        {groups_a_band, groups_of(painting_.height, tile_px), count},
        {&of_work, &strokes_, &segments_, &cells_->cell_first, &cells_->in_cells, &planes, &behind_or_wanted, &pixels},
        {&bristles_, &places_, &brush_picture_});
  };
  draw_pixels(only_wanted ? *views.wanted : behind);
  if (work.shows_behind == 0) {
    if (only_wanted) {
      const GpuBuffer rows(views.wanted->bytes());
      want_rows_.run({groups_of(painting_.height, 64), count}, {&of_work, &pixels, &rows});
      draw_pixels(rows);
    }
    continue_paint_.run({groups_of(painting_.height, 64), count}, {&of_work, &planes, &pixels});
  }
  if (relief_) relief_->light(surfaces, planes, views.positions, *cells_, pixels);
  return pixels;
}

}  // namespace wheatstone
