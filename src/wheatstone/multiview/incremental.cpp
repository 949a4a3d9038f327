#include <functional>
#include <optional>
#include <utility>

#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/shine_internal.h"

namespace wheatstone {
namespace {

/// As many views as are filled at a time: their light stays within the memory that one picture of each takes.
constexpr std::size_t views_at_a_time = 16;

/// Some of a rig's views, whose light is gathered at the same time.
struct ViewsAtOnce {
  std::span<const ViewPosition> views;
  const SplatOrders& orders;
  Deposit kind;
};

/// Adds splats of the central view to some of the views, `count` of them from the first on.
void deposit_in(const std::vector<SplatBlock>& blocks, std::size_t first, std::size_t count, const ViewsAtOnce& to,
                GatheredLight& light) {
  for_each_band(to.orders, [&](std::size_t picture, int b) {
    const SplatOrder& order = to.orders[picture];
    for (int part = 0; part < order.parts; ++part)
      for (const SplatBlock& block : blocks)
        deposit_in_views(to.kind, block.bin(order.bin(b, part)), b * order.band_rows, to.views.subspan(first, count),
                         light.band_in_targets(picture, b).subspan(first, count));
  });
}

void render_some(const RenderJob& job, std::span<const ViewPosition> views, std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrders orders = orders_for(job);
  // One enlarged frustum holds what any view sees (Hassaine 2010, sec. 4.3.1).
  const float around = look_around_px(job.scene, job.rig);
  const auto width = static_cast<float>(job.rig.width);
  const Window seen{.left = -around, .right = width + around, .height = job.rig.height};
  const Window shown{.left = 0, .right = width, .height = job.rig.height};
  const ViewsAtOnce to{views, orders, deposit_of(job.scene.splat_style)};
  GatheredLight light(orders, shown, to.kind, static_cast<int>(views.size()));
  std::optional<GatheredLight> highlights;
  if (job.scene.shine.lit()) highlights.emplace(orders, shown, to.kind, static_cast<int>(views.size()));
  const Projection projection = projection_for(job, orders);
  OrderingMemory memory;
  WaitingBlocks waiting(memory, [&](const auto& blocks) { deposit_in(blocks, 0, views.size(), to, light); });
  const auto take = [&](const Cloud& particles, const std::function<void(std::vector<SplatBlock>)>& draw) {
    const Chunks chunks = chunks_of(particles);
    for_each_ordered(of_chunks(job, chunks), projection, seen, orders, memory, draw);
  };
  // Those that shine are few: their light is each view's own, and the rest is not done again.
  for_each_chunk_and_highlights(
      job, views,
      [&](const Cloud& chunk) { take(chunk, [&](std::vector<SplatBlock> blocks) { waiting.add(std::move(blocks)); }); },
      [&](const Cloud& shining, std::size_t view) {
        take(shining, [&](const std::vector<SplatBlock>& blocks) { deposit_in(blocks, view, 1, to, *highlights); });
      });
  waiting.finish();
  if (highlights) light.add(*highlights);
  ViewPyramid pyramid(orders, job.rig, views.size(), job.tone.three_channels());
  for (std::size_t p = orders.size(); p-- > 0;) {
    const std::vector<ViewTarget> targets = pyramid.targets(p, pictures);
    for_each_band_of(orders[p], [&](int b) {
      for (std::size_t v = 0; v < views.size(); ++v)
        finish_band(light.band(p, b, static_cast<int>(v)), job.tone, b * orders[p].band_rows, targets[v]);
    });
    pyramid.share(p, targets, job.ranks);
  }
}

}  // namespace

void render_incremental(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures) {
  const std::span<const ViewPosition> views = job.rig.positions;
  for (std::size_t first = 0; first < views.size(); first += views_at_a_time) {
    const std::size_t count = std::min(views_at_a_time, views.size() - first);
    render_some(job, views.subspan(first, count), pictures.subspan(first, count));
  }
}

}  // namespace wheatstone
