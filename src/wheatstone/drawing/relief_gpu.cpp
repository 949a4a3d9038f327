#include <array>
#include <cstdint>
#include <vector>

#include "light_relief_source.h"
#include "relief_strokes_source.h"
#include "wheatstone/drawing/painting_gpu_internal.h"
#include "wheatstone/drawing/relief_internal.h"

namespace wheatstone {
namespace {

constexpr int relief_tile_px = 8;

/// Parameters of relief_strokes.comp: numbers of four bytes, without gaps.
struct ReliefWork {
  std::int32_t width = 0, height = 0;
  std::int32_t has_surfaces = 0;
  float tolerance_px = 0, bristle_px = 0, depth_px = 0;
  float still_depth = 0;
  std::int32_t first_cell = 0;
  std::uint32_t cells_a_band = 0;
  std::array<float, most_gpu_views> view{};
};

/// Strokes as relief_strokes.comp reads them, in the order of StrokesForGpu.
struct ReliefForGpu {
  struct Stroke {
    std::uint32_t seed;
    float radius_px, opacity;
    float middle_px, rim_px;
    float first_view, last_view;
    std::int32_t planned_in;
  };
  struct Segment {
    float x, y, dx, dy;
    float depth, depth_step;
    float begin_px, along_px;
    float reach;
    std::uint32_t stroke;
  };

  ReliefForGpu(const PreparedStrokes& painting, const Surfaces& surfaces) {
    for_strokes_from_nearest(painting, [&](const BandedLayer& layer, std::size_t place) {
      const FlatStroke& stroke = layer.flat.strokes[place];
      const BrushProfile brush(stroke.radius_px);
      add_segments(layer.flat, stroke, brush.reach_px);
      strokes.push_back({stroke.seed, stroke.radius_px, stroke.opacity, brush.middle_px, brush.rim_px,
                         stroke.views.first - central_view, stroke.views.last - central_view,
                         static_cast<std::int32_t>(kind_of(stroke.reference_view, surfaces))});
    });
  }

  std::vector<Stroke> strokes;
  std::vector<Segment> segments;

 private:
  void add_segments(const FlatLayer& layer, const FlatStroke& stroke, float reach) {
    for_segments(stroke, [&](std::uint32_t from, std::uint32_t to) {
      const auto change = [&](const std::vector<float>& of) { return of[to] - of[from]; };
      segments.push_back({layer.x[from], layer.y[from], change(layer.x), change(layer.y), layer.disparity[from],
                          change(layer.disparity), layer.along[from], change(layer.along), reach,
                          static_cast<std::uint32_t>(strokes.size())});
    });
  }
};

}  // namespace

GpuRelief::GpuRelief(const PreparedStrokes& painting, const Surfaces& surfaces, const Relief& relief)
    : width_(painting.width),
      height_(painting.height),
      relief_(relief),
      relief_strokes_(relief_strokes_source),
      light_relief_(light_relief_source) {
  const ReliefForGpu flat(painting, surfaces);
  strokes_.emplace(std::span<const ReliefForGpu::Stroke>(flat.strokes));
  segments_.emplace(std::span<const ReliefForGpu::Segment>(flat.segments));
}

void GpuRelief::light(const GpuSurfaces& surfaces, const GpuBuffer& planes, std::span<const ViewPosition> views,
                      const CellsOnGpu& cells, const GpuBuffer& pixels) const {
  const ReliefWork work{.width = width_,
                        .height = height_,
                        .has_surfaces = surfaces.empty() ? 0 : 1,
                        .tolerance_px = surfaces.tolerance_px(),
                        .bristle_px = relief_.bristle_px,
                        .depth_px = relief_.depth_px,
                        .still_depth = cells.still_depth,
                        .first_cell = cells.first_cell,
                        .cells_a_band = cells.cells_a_band,
                        .view = gpu_views(views)};
  const GpuBuffer of_work(std::span<const ReliefWork>(&work, 1));
  const GpuBuffer heights(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * views.size() *
                          sizeof(float));
  const auto count = static_cast<std::uint32_t>(views.size());
  relief_strokes_.run({groups_of(width_, relief_tile_px), groups_of(height_, relief_tile_px), count},
                      {&of_work, &*strokes_, &*segments_, &cells.cell_first, &cells.in_cells, &planes, &heights});
  light_relief_.run({groups_of(width_, 64), static_cast<std::uint32_t>(height_), count}, {&of_work, &heights, &pixels});
}

}  // namespace wheatstone
