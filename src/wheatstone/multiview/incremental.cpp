#include <tbb/parallel_for.h>

#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {
namespace {

/// As many views as are filled at a time: their light stays within the memory that one picture of each takes.
constexpr std::size_t views_at_a_time = 16;

void render_some(const RenderJob& job, std::span<const ViewPosition> views, std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrders orders = orders_for(job.rig, job.scene.splat_style);
  const Deposit kind = deposit_of(job.scene.splat_style);
  // One enlarged frustum holds what any view sees (Hassaine 2010, sec. 4.3.1).
  const float around = look_around_px(job.scene, job.rig);
  const auto width = static_cast<float>(job.rig.width);
  const Window seen{.left = -around, .right = width + around, .height = job.rig.height};
  GatheredLight light(orders, {.left = 0, .right = width, .height = job.rig.height}, static_cast<int>(views.size()));
  for_each_ordered(job.chunks, projection_for(job, orders), seen, orders, [&](const std::vector<SplatBlock>& blocks) {
    for_each_band(orders, [&](std::size_t picture, int b) {
      const SplatOrder& order = orders[picture];
      for (int part = 0; part < order.parts; ++part)
        for (const SplatBlock& block : blocks)
          deposit_in_views(kind, block.bin(order.bin(b, part)), b * order.band_rows, views,
                           light.band_in_targets(picture, b));
    });
  });
  ViewPyramid pyramid(orders, job.rig, views.size(), job.tone.three_channels());
  for (std::size_t p = orders.size(); p-- > 0;) {
    const std::vector<ViewTarget> targets = pyramid.targets(p, pictures);
    tbb::parallel_for(0, orders[p].bands, [&](int b) {
      for (std::size_t v = 0; v < views.size(); ++v)
        finish_band(light.band(p, b, static_cast<int>(v)), job.tone, b * orders[p].band_rows, targets[v]);
    });
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
