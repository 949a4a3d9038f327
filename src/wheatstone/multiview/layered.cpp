#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {

DepthPlanes planes_of(const DepthMapping& mapping, int count, float span) {
  const float nearest = mapping.points.front().parallax_px;
  const float farthest = mapping.points.back().parallax_px;
  if (count == 0) count = static_cast<int>(std::ceil((farthest - nearest) * std::max(span, 1.f))) + 1;
  DepthPlanes planes;
  planes.spacing_px = count > 1 && farthest > nearest ? (farthest - nearest) / static_cast<float>(count - 1) : 1.f;
  for (int i = 0; i < count; ++i)
    planes.parallaxes.push_back(count > 1 ? nearest + static_cast<float>(i) * planes.spacing_px
                                          : (nearest + farthest) / 2);
  return planes;
}

SplatOrder order_by_plane(const Rig& rig, const SplatStyle& splat_style, const DepthPlanes& planes,
                          SliceFilter filter) {
  SplatOrder order = bands_of(rig, splat_style);
  order.within = filter == SliceFilter::centroid ? SplatOrder::Within::nearer_plane : SplatOrder::Within::nearest_plane;
  order.parts = static_cast<int>(planes.parallaxes.size());
  order.first = planes.parallaxes.front();
  order.spacing = planes.spacing_px;
  return order;
}

Resampling resampling_of(SliceFilter filter) {
  switch (filter) {
    case SliceFilter::nearest:
      return Resampling::nearest;
    case SliceFilter::linear:
      return Resampling::linear;
    default:
      return Resampling::cubic;
  }
}

Window window_around(const Scene& scene, const Rig& rig) {
  const float around = std::ceil(look_around_px(scene, rig)) + 2;
  return {.left = -around, .right = static_cast<float>(rig.width) + around, .height = rig.height};
}

PlaneFiller::PlaneFiller(const Window& window, const SplatOrder& order)
    : order_(order),
      plane_(static_cast<int>(window.left), static_cast<int>(window.right), order.band_rows),
      next_(static_cast<int>(window.left), static_cast<int>(window.right), order.band_rows, 3) {}

LightBand& PlaneFiller::fill(const std::vector<SplatBlock>& blocks, int b, int plane) {
  const bool between = order_.within == SplatOrder::Within::nearer_plane && plane + 1 < order_.parts;
  const PlanePair pair{order_.first + static_cast<float>(plane) * order_.spacing, order_.spacing};
  const int top = b * order_.band_rows;
  // What the plane before gave to this one is there already; the other band was taken, and is dark.
  if (order_.within == SplatOrder::Within::nearer_plane && plane > 0) std::swap(plane_, next_);
  for (const SplatBlock& block : blocks) {
    const std::span<const Splat> splats = block.bin(order_.bin(b, plane));
    if (between) {
      deposit_between(splats, top, pair, plane_, next_);
    } else {
      deposit(splats, top, plane_);
    }
  }
  return plane_;
}

void PlaneFiller::begin_band() {
  plane_.darken();
  next_.darken();
}

namespace {

/// What one thread works in.
struct Workplace {
  PlaneFiller filler;
  SliceBand slices;
};

}  // namespace

void render_layered(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter,
                    std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrder order = order_by_plane(job.rig, job.scene.splat_style, planes, filter);
  const Window window = window_around(job.scene, job.rig);
  const std::vector<SplatBlock> blocks =
      order_splats(job.cloud, make_projection(job.scene, job.statistics), window, order);

  const Compositing compositing{planes.parallaxes, job.rig.positions, resampling_of(filter)};
  tbb::enumerable_thread_specific<Workplace> workplaces([&] {
    return Workplace{
        PlaneFiller(window, order),
        SliceBand(static_cast<int>(window.left), static_cast<int>(window.right), order.band_rows, order.parts)};
  });
  tbb::parallel_for(0, order.bands, [&](int b) {
    Workplace& work = workplaces.local();
    work.filler.begin_band();
    for (int plane = 0; plane < order.parts; ++plane) work.slices.take(plane, work.filler.fill(blocks, b, plane));
    if (!pictures.empty()) composite(work.slices, compositing, job.tone, b * order.band_rows, pictures);
  });
}

}  // namespace wheatstone
