#include <optional>
#include <utility>

#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/shine_internal.h"

namespace wheatstone {
namespace {

void deposit_all(const std::vector<SplatBlock>& blocks, const SplatOrders& orders, Deposit kind, GatheredLight& light) {
  for_each_band(orders, [&](std::size_t picture, int b) {
    const SplatOrder& order = orders[picture];
    for (int part = 0; part < order.parts; ++part)
      for (const SplatBlock& block : blocks)
        deposit(kind, block.bin(order.bin(b, part)), b * order.band_rows, light.band(picture, b, 0));
  });
}

/// Gathers the light of one view, and finishes it from the smallest picture to the view's own.
void make_view(const RenderJob& job, ViewPosition view, std::span<const ImageView<Rgb8>> picture, ViewPyramid& pyramid,
               GatheredLight& light) {
  const SplatOrders orders = orders_for(job);
  const Window window{.left = 0, .right = static_cast<float>(job.rig.width), .height = job.rig.height};
  const Deposit kind = deposit_of(job.scene.splat_style);
  const Projection projection = projection_for(job, orders, view);
  light.darken();
  std::optional<GatheredLight> highlights;
  if (job.scene.shine.lit()) highlights.emplace(orders, window, kind, 1);
  OrderingMemory memory;
  WaitingBlocks waiting(memory, [&](const auto& blocks) { deposit_all(blocks, orders, kind, light); });
  WaitingBlocks waiting_highlights(memory, [&](const auto& blocks) { deposit_all(blocks, orders, kind, *highlights); });
  const auto take = [&](const Cloud& particles, WaitingBlocks& to) {
    const Chunks chunks = chunks_of(particles);
    for_each_ordered(of_chunks(job, chunks), projection, window, orders, memory,
                     [&](std::vector<SplatBlock> blocks) { to.add(std::move(blocks)); });
  };
  for_each_chunk_and_highlights(
      job, {&view, 1}, [&](const Cloud& chunk) { take(chunk, waiting); },
      [&](const Cloud& shining, std::size_t /*view*/) { take(shining, waiting_highlights); });
  waiting.finish();
  waiting_highlights.finish();
  if (highlights) light.add(*highlights);
  for (std::size_t p = orders.size(); p-- > 0;) {
    const std::vector<ViewTarget> target = pyramid.targets(p, picture);
    for_each_band_of(
        orders[p], [&](int b) { finish_band(light.band(p, b, 0), job.tone, b * orders[p].band_rows, target.front()); });
    pyramid.share(p, target, job.ranks);
  }
}

GatheredLight light_for_view(const RenderJob& job) {
  const Window window{.left = 0, .right = static_cast<float>(job.rig.width), .height = job.rig.height};
  return {orders_for(job), window, deposit_of(job.scene.splat_style), 1};
}

}  // namespace

void render_exact(const RenderJob& job, std::span<const ViewPosition> views,
                  std::span<const ImageView<Rgb8>> pictures) {
  GatheredLight light = light_for_view(job);
  for (std::size_t v = 0; v < views.size(); ++v) {
    ViewPyramid pyramid(orders_for(job), job.rig, 1, job.tone.three_channels());
    make_view(job, views[v], pictures.subspan(v, 1), pyramid, light);
  }
}

ViewLight light_of_view(const RenderJob& job, ViewPosition view) {
  if (job.scene.splat_style.blend == Blend::over) {
    ViewLight seen(job.rig.width, job.rig.height, 3);
    const ViewTarget target{.light = &seen};
    render_front_to_back(job, {&view, 1}, {&target, 1});
    return seen;
  }
  GatheredLight light = light_for_view(job);
  ViewPyramid pyramid(orders_for(job), job.rig, 1, job.tone.three_channels());
  make_view(job, view, {}, pyramid, light);
  return pyramid.light(0);
}

}  // namespace wheatstone
