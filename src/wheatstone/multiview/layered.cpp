#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/shine_internal.h"

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

Window window_around(const Scene& scene, const Rig& rig, float gain) {
  const float around = std::ceil(look_around_px(scene, rig) * gain) + 2;
  return {.left = -around, .right = static_cast<float>(rig.width) + around, .height = rig.height};
}

PlaneFiller::PlaneFiller(const Window& window, const SplatOrder& order, Deposit kind)
    : order_(order),
      kind_(kind),
      plane_(static_cast<int>(window.left), static_cast<int>(window.right), order.band_rows, channels_in(kind)),
      next_(static_cast<int>(window.left), static_cast<int>(window.right), order.band_rows, channels_in(kind), 3) {}

LightBand& PlaneFiller::fill(const std::vector<SplatBlock>& blocks, int b, int plane) {
  const bool shared = order_.within == SplatOrder::Within::nearer_plane;
  // `next_` holds the previous plane's share in this plane; `plane_` was read and darkened.
  if (shared && plane > 0) std::swap(plane_, next_);
  for (const SplatBlock& block : blocks) deposit_plane(block, order_, kind_, {b, plane}, plane_, next_);
  return plane_;
}

void PlaneFiller::begin_band() {
  plane_.darken();
  next_.darken();
}

void deposit_plane(const SplatBlock& block, const SplatOrder& order, Deposit kind, BandPlane at, LightBand& here,
                   LightBand& next) {
  const std::span<const Splat> splats = block.bin(order.bin(at.band, at.plane));
  const int top = at.band * order.band_rows;
  if (order.within == SplatOrder::Within::nearer_plane && at.plane + 1 < order.parts) {
    const float parallax = order.first * order.scale + static_cast<float>(at.plane) * order.spacing;
    deposit_between(kind, splats, top, {parallax, order.spacing}, here, next);
  } else {
    deposit(kind, splats, top, here);
  }
}

void deposit_in_planes(const std::vector<SplatBlock>& blocks, const SplatOrders& orders, Deposit kind,
                       GatheredLight& light) {
  for_each_band(orders, [&](std::size_t picture, int b) {
    const SplatOrder& order = orders[picture];
    const auto fill = [&](int plane) {
      for (const SplatBlock& block : blocks)
        deposit_plane(block, order, kind, {b, plane}, light.band(picture, b, plane),
                      light.band(picture, b, std::min(plane + 1, order.parts - 1)));
    };
    // Where no splat lies in two planes, planes do not wait for each other: there are fewer bands than threads where
    // ranks share them.
    if (order.within == SplatOrder::Within::nearest_plane) {
      tbb::parallel_for(0, order.parts, fill);
    } else {
      for (int plane = 0; plane < order.parts; ++plane) fill(plane);
    }
  });
}

Window window_of_planes(const RenderJob& job) {
  return window_around(job.scene, job.rig, job.focus ? job.focus->largest_gain() : 1.f);
}

std::optional<Focus> focus_in(const std::optional<Focus>& focus, const SplatOrder& order) {
  if (!focus) return {};
  const auto pad = static_cast<float>(order.pad);
  return Focus{.x_px = focus->x_px * order.scale + pad,
               .y_px = focus->y_px * order.scale + pad,
               .radius_px = focus->radius_px * order.scale,
               .gain = focus->gain};
}

namespace {

/// The data that is kept between reading particles and compositing: the light of all planes, or all splats, whichever
/// is less.
struct KeptForPlanes {
  std::vector<SplatBlock> splats;
  std::optional<GatheredLight> light;
};

/// kept[0] is the light that all views see; kept[1 + k] are the highlights seen from keys[k]. Highlights of other views
/// are interpolated between keys.
struct PlanesOfViews {
  std::vector<KeptForPlanes> kept;
  std::vector<ViewPosition> keys;
};

bool light_is_less(const SplatOrders& orders, const Window& window, Deposit kind, std::uint64_t particles) {
  const double width = static_cast<double>(window.right) - window.left + 2 * LightBand::margin;
  double pixels = 0;
  for (const SplatOrder& order : orders) pixels += width * order.scale * order.rows * order.parts;
  // A splat may stand in two bands, and a few bytes more say where.
  return pixels * channels_in(kind) * sizeof(float) < 1.3 * sizeof(Splat) * static_cast<double>(particles);
}

PlanesOfViews keep(const RenderJob& job, const SplatOrders& orders, const Window& window) {
  PlanesOfViews planes;
  const Deposit kind = deposit_of(job.scene.splat_style);
  const Projection projection = projection_for(job, orders);
  const Shine& shine = job.scene.shine;
  if (shine.lit()) planes.keys = shine_keys(shine, job.rig.positions);
  planes.kept.resize(1 + planes.keys.size());
  if (light_is_less(orders, window, kind, job.statistics.count)) planes.kept[0].light.emplace(orders, window, kind, 0);
  OrderingMemory memory;
  WaitingBlocks waiting(memory,
                        [&](const auto& blocks) { deposit_in_planes(blocks, orders, kind, *planes.kept[0].light); });
  const auto take = [&](const Cloud& particles, KeptForPlanes& kept) {
    const Chunks chunks = chunks_of(particles);
    for_each_ordered(of_chunks(job, chunks), projection, window, orders, memory, [&](std::vector<SplatBlock> blocks) {
      if (kept.light) {
        waiting.add(std::move(blocks));
      } else {
        std::ranges::move(blocks, std::back_inserter(kept.splats));
      }
    });
  };
  for_each_chunk_and_highlights(
      job, planes.keys, [&](const Cloud& chunk) { take(chunk, planes.kept[0]); },
      [&](const Cloud& shining, std::size_t key) { take(shining, planes.kept[key + 1]); });
  waiting.finish();
  return planes;
}

/// The memory in which one thread works.
struct Workplace {
  PlaneFiller filler;
  SliceBand slices;
};

/// The share of each plane's light that each view sees: 1 for the common light, less for highlights. Empty if there
/// are no highlights.
std::vector<std::vector<float>> shares_of_planes(const PlanesOfViews& planes, const Rig& rig, int parts) {
  if (planes.keys.empty()) return {};
  const auto planes_a_set = static_cast<std::size_t>(parts);
  std::vector<std::vector<float>> shares = shares_of_keys(planes.keys, rig.positions);
  for (std::vector<float>& of_view : shares) {
    std::vector<float> of_planes(planes_a_set, 1.f);
    for (const float share : of_view) of_planes.insert(of_planes.end(), planes_a_set, share);
    of_view = std::move(of_planes);
  }
  return shares;
}

/// Composites one of the pictures of all views.
void composite_picture(const RenderJob& job, SliceFilter filter, const SplatOrders& orders, std::size_t picture,
                       PlanesOfViews& planes, std::span<const ViewTarget> targets) {
  const SplatOrder& order = orders[picture];
  const Window window = window_in(window_of_planes(job), order);
  const int sets = static_cast<int>(planes.kept.size());
  std::vector<float> parallaxes;
  for (int set = 0; set < sets; ++set)
    for (int plane = 0; plane < order.parts; ++plane)
      parallaxes.push_back(order.first * order.scale + static_cast<float>(plane) * order.spacing);
  const std::vector<std::vector<float>> shares = shares_of_planes(planes, job.rig, order.parts);
  const Compositing compositing{parallaxes, job.rig.positions, filter, focus_in(job.focus, order), shares};
  tbb::enumerable_thread_specific<Workplace> workplaces([&] {
    return Workplace{
        PlaneFiller(window, order, deposit_of(job.scene.splat_style)),
        SliceBand(static_cast<int>(window.left), static_cast<int>(window.right), order.band_rows, sets * order.parts)};
  });
  for_each_band_of(order, [&](int b) {
    Workplace& work = workplaces.local();
    for (int set = 0; set < sets; ++set) {
      KeptForPlanes& kept = planes.kept[static_cast<std::size_t>(set)];
      work.filler.begin_band();
      for (int plane = 0; plane < order.parts; ++plane)
        work.slices.take(set * order.parts + plane,
                         kept.light ? kept.light->band(picture, b, plane) : work.filler.fill(kept.splats, b, plane));
    }
    if (!targets.empty()) composite(work.slices, compositing, job.tone, b * order.band_rows, targets);
  });
}

}  // namespace

void render_layered(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter,
                    std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrders orders = orders_by_plane(job, planes, filter);
  PlanesOfViews kept = keep(job, orders, window_of_planes(job));
  ViewPyramid pyramid(orders, job.rig, pictures.size(), job.tone.three_channels());
  for (std::size_t p = orders.size(); p-- > 0;) {
    const std::vector<ViewTarget> targets = pyramid.targets(p, pictures);
    composite_picture(job, filter, orders, p, kept, targets);
    pyramid.share(p, targets, job.ranks);
  }
}

}  // namespace wheatstone
