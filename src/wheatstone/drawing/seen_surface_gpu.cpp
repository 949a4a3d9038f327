#include "wheatstone/drawing/seen_surface_gpu_internal.h"

#include <array>
#include <cstdint>
#include <vector>

#include "see_surfaces_source.h"
#include "wheatstone/gpu/views.h"

namespace wheatstone {

/// Surfaces as see_surfaces.comp reads them: all parts, one after the other.
struct FlatSurfaces {
  struct Part {
    float view;
    std::int32_t left_px, continued, rows;
    std::uint32_t first_row;
  };
  struct Run {
    std::int32_t begin, end;
    std::uint32_t first_value;
  };

  explicit FlatSurfaces(const Surfaces& surfaces) {
    for (const Surface& surface : surfaces.seen) {
      const KnownRuns& known = surface.disparity;
      const auto first_run = static_cast<std::uint32_t>(runs.size());
      const auto first_value = static_cast<std::uint32_t>(disparities.size());
      parts.push_back({surface.view - central_view, surface.left_px, surface.continued ? 1 : 0, known.height(),
                       static_cast<std::uint32_t>(first_runs.size())});
      for (const std::size_t run : known.first_runs())
        first_runs.push_back(first_run + static_cast<std::uint32_t>(run));
      for (const KnownRuns::Run& run : known.runs())
        runs.push_back({run.begin, run.end, first_value + static_cast<std::uint32_t>(run.first_value)});
      disparities.insert(disparities.end(), known.values().begin(), known.values().end());
    }
  }

  std::vector<Part> parts;
  std::vector<std::uint32_t> first_runs;
  std::vector<Run> runs;
  std::vector<float> disparities;
};

namespace {

/// Parameters of see_surfaces.comp: numbers of four bytes, without gaps.
struct SeeWork {
  std::int32_t width = 0, height = 0, parts = 0;
  std::array<float, most_gpu_views> view{};
};

}  // namespace

GpuSurfaces::GpuSurfaces(const Surfaces& surfaces) : GpuSurfaces(surfaces, FlatSurfaces(surfaces)) {}

GpuSurfaces::GpuSurfaces(const Surfaces& surfaces, const FlatSurfaces& flat)
    : parts_(static_cast<int>(flat.parts.size())),
      tolerance_px_(surfaces.tolerance_px),
      see_surfaces_(see_surfaces_source),
      of_parts_(std::span(flat.parts)),
      first_runs_(std::span(flat.first_runs)),
      runs_(std::span(flat.runs)),
      disparities_(std::span(flat.disparities)) {}

GpuBuffer GpuSurfaces::seen(std::span<const ViewPosition> views, int width, int height) const {
  if (empty()) return GpuBuffer(0);
  GpuBuffer planes(views.size() * planes_a_view * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                   sizeof(float));
  const SeeWork work{width, height, parts_, gpu_views(views)};
  const GpuBuffer of_work(std::span<const SeeWork>(&work, 1));
  see_surfaces_.run({groups_of(static_cast<std::size_t>(height), 64), static_cast<std::uint32_t>(views.size())},
                    {&of_work, &of_parts_, &first_runs_, &runs_, &disparities_, &planes});
  return planes;
}

}  // namespace wheatstone
