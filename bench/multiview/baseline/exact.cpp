#include "multiview/baseline/exact.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "multiview/baseline/tone_map.h"
#include "wheatstone/percentile.h"

namespace wheatstone::baseline {
namespace {

SplatOrder bands_of(const Rig& rig, const SplatStyle& splat_style) {
  SplatOrder order;
  order.band_rows = 32;
  order.bands = (rig.height + order.band_rows - 1) / order.band_rows;
  order.spacing = std::max(64.f, splat_style.largest_px);
  order.parts = static_cast<int>(static_cast<float>(rig.width) / order.spacing) + 1;
  return order;
}

void deposit_band(const std::vector<SplatBlock>& blocks, const SplatOrder& order, int b, LightBand& band) {
  for (int part = 0; part < order.parts; ++part)
    for (const SplatBlock& block : blocks) deposit(block.bin(order.bin(b, part)), b * order.band_rows, band);
}

std::vector<SplatBlock> splats_of_view(const Cloud& cloud, const Projection& projection, const Rig& rig,
                                       const SplatOrder& order) {
  const Window window{.left = 0, .right = static_cast<float>(rig.width), .height = rig.height};
  return order_splats(cloud, projection, window, order);
}

float automatic_exposure(const Cloud& cloud, const Scene& scene, const Rig& rig, const CloudStatistics& statistics) {
  const SplatOrder order = bands_of(rig, scene.splat_style);
  const std::vector<SplatBlock> blocks =
      splats_of_view(cloud, make_projection(scene, statistics, central_view), rig, order);
  std::vector<LightBand> light(order.bands, LightBand(0, rig.width, order.band_rows));
  tbb::parallel_for(0, order.bands, [&](int b) { deposit_band(blocks, order, b, light[b]); });
  std::vector<float> brightest;
  for (const LightBand& band : light)
    for (int row = 0; row < band.rows(); ++row)
      for (int x = 0; x < rig.width; ++x) {
        const float* const pixel = band.row(row) + x * LightBand::channels;
        brightest.push_back(std::max({pixel[0], pixel[1], pixel[2]}));
      }
  std::erase_if(brightest, [](float one) { return one <= 0; });
  return brightest.empty() ? 1 : 3 / percentile(std::move(brightest), 0.99);
}

}  // namespace

void render_exact(const Cloud& cloud, const Scene& scene, const Rig& rig, ViewPosition view, float exposure,
                  ImageView<Rgb8> picture) {
  CloudStatistics statistics;
  statistics.add(cloud);
  if (std::isnan(exposure)) exposure = automatic_exposure(cloud, scene, rig, statistics);
  const ToneMap tone(exposure);
  const SplatOrder order = bands_of(rig, scene.splat_style);
  const std::vector<SplatBlock> blocks = splats_of_view(cloud, make_projection(scene, statistics, view), rig, order);
  tbb::enumerable_thread_specific<LightBand> bands([&] { return LightBand(0, rig.width, order.band_rows); });
  tbb::parallel_for(0, order.bands, [&](int b) {
    LightBand& band = bands.local();
    band.darken();
    deposit_band(blocks, order, b, band);
    tone_map(band, tone, b * order.band_rows, picture);
  });
}

}  // namespace wheatstone::baseline
