#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {
namespace {

void deposit_band(const std::vector<SplatBlock>& blocks, const SplatOrder& order, int b, LightBand& band) {
  for (int part = 0; part < order.parts; ++part)
    for (const SplatBlock& block : blocks) deposit(block.bin(order.bin(b, part)), b * order.band_rows, band);
}

std::vector<SplatBlock> splats_of_view(const Cloud& cloud, const Projection& projection, const Rig& rig,
                                       const SplatOrder& order) {
  const Window window{.left = 0, .right = static_cast<float>(rig.width), .height = rig.height};
  return order_splats(cloud, projection, window, order);
}

}  // namespace

void render_exact(const RenderJob& job, ViewPosition view, ImageView<Rgb8> picture) {
  const SplatOrder order = bands_of(job.rig, job.scene.splat_style);
  const std::vector<SplatBlock> blocks =
      splats_of_view(job.cloud, make_projection(job.scene, job.statistics, view), job.rig, order);
  tbb::enumerable_thread_specific<LightBand> bands([&] { return LightBand(0, job.rig.width, order.band_rows); });
  tbb::parallel_for(0, order.bands, [&](int b) {
    LightBand& band = bands.local();
    band.darken();
    deposit_band(blocks, order, b, band);
    tone_map(band, job.tone, b * order.band_rows, picture);
  });
}

std::vector<LightBand> light_of_view(const Cloud& cloud, const Scene& scene, const Rig& rig,
                                     const CloudStatistics& statistics, ViewPosition view) {
  const SplatOrder order = bands_of(rig, scene.splat_style);
  const std::vector<SplatBlock> blocks = splats_of_view(cloud, make_projection(scene, statistics, view), rig, order);
  std::vector<LightBand> light(order.bands, LightBand(0, rig.width, order.band_rows));
  tbb::parallel_for(0, order.bands, [&](int b) { deposit_band(blocks, order, b, light[b]); });
  return light;
}

}  // namespace wheatstone
