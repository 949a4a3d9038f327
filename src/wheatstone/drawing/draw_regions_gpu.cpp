#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "finish_regions_source.h"
#include "sample_regions_source.h"
#include "wheatstone/drawing/painting_gpu_internal.h"

namespace wheatstone {
namespace {

constexpr int samples_a_side = 4, rows_a_group = 8;

/// Parameters of sample_regions.comp: numbers of four bytes, without gaps.
struct RegionWork {
  std::int32_t width = 0, height = 0, first_row = 0, rows = 0;
  std::int32_t has_surfaces = 0, bands_rows = rows_a_group;
  float tolerance_px = 0;
  std::array<float, most_gpu_views> view{};
};

/// Regions as sample_regions.comp reads them.
struct RegionsForGpu {
  struct Mark {
    std::uint32_t colour;
    float reference_view, first_view, last_view;
    std::int32_t is_own;
  };
  struct InBand {
    std::uint32_t mark, first_edge, end_edge;
  };
  struct Edge {
    float x, y, disparity;
    float dx, dy, disparity_step;
    float bottom() const { return y + dy; }
  };

  RegionsForGpu(const RegionPainting& painting, const Surfaces& surfaces) {
    std::vector<std::vector<Edge>> of_marks;
    for (const RegionMark& mark : painting.marks) {
      marks.push_back({packed(mark.colour), mark.reference_view - central_view, mark.views.first - central_view,
                       mark.views.last - central_view,
                       kind_of(mark.reference_view, surfaces) == PlannedIn::reference_view ? 1 : 0});
      of_marks.push_back(edges_of(painting, mark));
    }
    const int bands = (painting.height + rows_a_group - 1) / rows_a_group;
    for (int band = 0; band < bands; ++band) {
      band_first.push_back(static_cast<std::uint32_t>(in_bands.size()));
      for (const int own : {1, 0})
        for (std::uint32_t m = 0; m < marks.size(); ++m)
          if (marks[m].is_own == own) add_to_band(band, m, of_marks[m]);
    }
    band_first.push_back(static_cast<std::uint32_t>(in_bands.size()));
  }

  std::vector<Mark> marks;
  std::vector<std::uint32_t> band_first;
  std::vector<InBand> in_bands;
  std::vector<Edge> edges;

 private:
  /// Those that a line of samples may cross, from top to bottom.
  static std::vector<Edge> edges_of(const RegionPainting& painting, const RegionMark& mark) {
    std::vector<Edge> found;
    for (const Ring& ring : painting.rings_of(mark)) {
      const auto points = painting.points_of(ring);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [a, b] =
            std::minmax(points[i], points[(i + 1) % points.size()],
                        [](const ControlPoint& upper, const ControlPoint& lower) { return upper.y < lower.y; });
        if (a.y < b.y) found.push_back({a.x, a.y, a.disparity, b.x - a.x, b.y - a.y, b.disparity - a.disparity});
      }
    }
    return found;
  }

  void add_to_band(int band, std::uint32_t mark, const std::vector<Edge>& of_mark) {
    const auto top = static_cast<float>(band * rows_a_group), bottom = top + rows_a_group;
    const auto first = static_cast<std::uint32_t>(edges.size());
    std::ranges::copy_if(of_mark, std::back_inserter(edges),
                         [&](const Edge& edge) { return edge.y < bottom && edge.bottom() > top; });
    const auto end = static_cast<std::uint32_t>(edges.size());
    if (first < end) in_bands.push_back({mark, first, end});
  }
};

}  // namespace

GpuRegions::GpuRegions(const RegionPainting& painting, const Surfaces& surfaces)
    : painting_(painting), sample_regions_(sample_regions_source), finish_regions_(finish_regions_source) {
  const RegionsForGpu flat(painting, surfaces);
  buffers_.emplace(Buffers{GpuBuffer(std::span<const RegionsForGpu::Mark>(flat.marks)),
                           GpuBuffer(std::span<const std::uint32_t>(flat.band_first)),
                           GpuBuffer(std::span<const RegionsForGpu::InBand>(flat.in_bands)),
                           GpuBuffer(std::span<const RegionsForGpu::Edge>(flat.edges))});
}

GpuBuffer GpuRegions::draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const {
  const int width = painting_.width, height = painting_.height;
  const std::size_t count = views.positions.size();
  GpuBuffer pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * count * sizeof(std::uint32_t));
  // The samples of so many rows are held at once.
  constexpr std::size_t most_bytes = std::size_t{1} << 26;
  const std::size_t bytes_a_row =
      static_cast<std::size_t>(width) * samples_a_side * samples_a_side * count * sizeof(float);
  const int rows_at_once = static_cast<int>(std::clamp<std::size_t>(most_bytes / bytes_a_row, 1, height));
  const GpuBuffer disparities(rows_at_once * bytes_a_row), shown(rows_at_once * bytes_a_row);
  for (int first_row = 0; first_row < height; first_row += rows_at_once) {
    const RegionWork work{.width = width,
                          .height = height,
                          .first_row = first_row,
                          .rows = std::min(rows_at_once, height - first_row),
                          .has_surfaces = surfaces.empty() ? 0 : 1,
                          .tolerance_px = surfaces.tolerance_px(),
                          .view = gpu_views(views.positions)};
    const GpuBuffer of_work(std::span<const RegionWork>(&work, 1));
    const auto of_views = static_cast<std::uint32_t>(count);
    sample_regions_.run({groups_of(static_cast<std::size_t>(work.rows) * samples_a_side, 64), of_views},
                        {&of_work, &buffers_->marks, &buffers_->band_first, &buffers_->in_bands, &buffers_->edges,
                         &planes, &disparities, &shown});
    finish_regions_.run({groups_of(work.rows, 64), of_views},
                        {&of_work, &buffers_->marks, &disparities, &shown, &pixels});
  }
  return pixels;
}

}  // namespace wheatstone
