#include <algorithm>
#include <optional>
#include <vector>

#include "wheatstone/gpu/gpu.h"
#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/gpu_finish_internal.h"
#include "wheatstone/multiview/gpu_splats_internal.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {
namespace {

/// Some of the job's views, and their pictures.
struct SomeViews {
  std::span<const ViewPosition> positions;
  std::span<const ImageView<Rgb8>> pictures;
};

/// Calls `take` with at most so many views at a time.
template <class Take>
void for_some_views(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures, std::size_t most, Take take) {
  for (std::size_t first = 0; first < pictures.size(); first += most) {
    const std::size_t count = std::min(most, pictures.size() - first);
    take(SomeViews{std::span(job.rig.positions).subspan(first, count), pictures.subspan(first, count)});
  }
}

/// As many views as one buffer has room for, with so many bytes for each number of a pixel.
std::size_t views_that_fit(const GpuPictures& pictures, std::size_t bytes_a_value, std::size_t largest_buffer) {
  std::size_t values = 0;
  for (std::size_t p = 0; p < pictures.size(); ++p) values += pictures.values(p);
  return std::clamp<std::size_t>(largest_buffer / (values * bytes_a_value), 1, most_gpu_views);
}

/// The group that holds a picture's targets, where one group holds them all.
std::size_t group_of(std::span<const TargetGroup> groups, std::size_t picture) {
  const auto holds = [picture](const TargetGroup& group) { return group.first[picture] < group.end[picture]; };
  return static_cast<std::size_t>(std::ranges::find_if(groups, holds) - groups.begin());
}

/// The pictures as every view of the job has them.
GpuPictures pictures_of_views(const RenderJob& job, const SplatOrders& orders) {
  const Window view{.left = 0, .right = static_cast<float>(job.rig.width), .height = job.rig.height};
  return gpu_pictures(orders, view, job.tone.three_channels() ? 3 : 2);
}

}  // namespace

void render_incremental_on_gpu(const RenderJob& job, bool opaque, std::span<const ImageView<Rgb8>> pictures) {
  on_gpu([&](const GpuFacts& facts) {
    GpuPictures sizes = pictures_of_views(job, orders_for(job));
    const GpuTargets targets = opaque ? GpuTargets::discs_in_views : GpuTargets::views;
    for_some_views(job, pictures, views_that_fit(sizes, sum_bytes, facts.largest_buffer), [&](const SomeViews& views) {
      std::ranges::fill(sizes.targets, static_cast<int>(views.positions.size()));
      const LightOnGpu gathered = light_on_gpu(job, facts, sizes, targets, views.positions);
      const auto light_of = [&](std::size_t p) {
        const std::size_t g = group_of(gathered.groups, p);
        return GpuLight{&gathered.light[g], gathered.groups[g].base[p]};
      };
      finish_on_gpu(sizes, job.tone, light_of, views.pictures);
    });
  });
}

void render_layered_on_gpu(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter,
                           std::span<const ImageView<Rgb8>> pictures) {
  on_gpu([&](const GpuFacts& facts) {
    const SplatOrders orders = orders_by_plane(job, planes, filter);
    const GpuPictures sizes = pictures_of_views(job, orders);
    const GpuPictures of_planes = gpu_pictures(orders, window_of_planes(job), sizes.channels);
    const GpuTargets targets = filter == SliceFilter::centroid ? GpuTargets::between_planes : GpuTargets::nearest_plane;
    const GpuCompositor compositor(of_planes, light_on_gpu(job, facts, of_planes, targets, {}), filter, job.focus);
    for_some_views(job, pictures, views_that_fit(sizes, sizeof(float), facts.largest_buffer),
                   [&](const SomeViews& views) {
                     std::optional<GpuBuffer> composited;
                     const auto light_of = [&](std::size_t p) {
                       composited.emplace(compositor.composite(p, sizes, views.positions));
                       return GpuLight{&*composited, 0};
                     };
                     finish_on_gpu(sizes, job.tone, light_of, views.pictures);
                   });
  });
}

}  // namespace wheatstone
