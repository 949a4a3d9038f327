#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {

void render_incremental(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrder order = bands_of(job.rig, job.scene.splat_style);
  // One enlarged frustum holds what any view sees (Hassaine 2010, sec. 4.3.1).
  const float around = look_around_px(job.scene, job.rig);
  const Window window{.left = -around, .right = static_cast<float>(job.rig.width) + around, .height = job.rig.height};
  const std::vector<SplatBlock> blocks =
      order_splats(job.cloud, make_projection(job.scene, job.statistics), window, order);

  tbb::enumerable_thread_specific<std::vector<LightBand>> bands([&] {
    std::vector<LightBand> views;
    for (std::size_t v = 0; v < job.rig.positions.size(); ++v)
      views.emplace_back(0, job.rig.width, order.band_rows, static_cast<int>(v));
    return views;
  });
  tbb::parallel_for(0, order.bands, [&](int b) {
    std::vector<LightBand>& views = bands.local();
    for (LightBand& band : views) band.darken();
    for (int part = 0; part < order.parts; ++part)
      for (const SplatBlock& block : blocks)
        deposit_in_views(block.bin(order.bin(b, part)), b * order.band_rows, job.rig.positions, views);
    for (std::size_t v = 0; v < views.size(); ++v) tone_map(views[v], job.tone, b * order.band_rows, pictures[v]);
  });
}

}  // namespace wheatstone
