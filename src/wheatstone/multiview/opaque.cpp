#include "wheatstone/multiview/opaque_internal.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/multiview/deal_out_internal.h"
#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/sphere_light_internal.h"
#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {
namespace {

LinearRgba light_of(const Splat& splat) {
  return {float_from_half(splat.colour[0]), float_from_half(splat.colour[1]), float_from_half(splat.colour[2]), 1};
}

void tone_map_rows(const OpaqueBand& band, const ToneMap& tone, int top, ImageView<Rgb8> picture) {
  const int rows = std::min(band.light.height(), picture.height() - top);
  for (int row = 0; row < rows; ++row)
    for (int x = 0; x < picture.width(); ++x) {
      const LinearRgba& light = band.light(x, row);
      picture(x, top + row) = tone(light.r, light.g, light.b);
    }
}

}  // namespace

void draw_spheres(std::span<const Splat> splats, int top, ViewPosition view, OpaqueBand& band) {
  const int width = band.light.width();
  for (const Splat& splat : splats) {
    // At least a pixel's width, so that some centre is met.
    const float radius = std::max(float_from_half(splat.size) / 2, 0.71f);
    const float x = std::fma(splat.parallax, view - central_view, splat.x) - static_cast<float>(band.left) - 0.5f;
    const float y = splat.y - static_cast<float>(top) - 0.5f;
    const int first_row = std::max(static_cast<int>(std::ceil(y - radius)), 0);
    const int end_row = std::min(static_cast<int>(std::floor(y + radius)) + 1, band.light.height());
    const LinearRgba light = light_of(splat);
    for (int row = first_row; row < end_row; ++row) {
      const float off = static_cast<float>(row) - y;
      const float half_width = std::sqrt(std::max(radius * radius - off * off, 0.f));
      const int first = std::max(static_cast<int>(std::ceil(x - half_width)), 0);
      const int end = std::min(static_cast<int>(std::floor(x + half_width)) + 1, width);
      for (int column = first; column < end; ++column) {
        if (splat.parallax >= band.parallax(column, row)) continue;
        band.parallax(column, row) = splat.parallax;
        const float share = light_on_sphere((static_cast<float>(column) - x) / radius, off / radius, radius);
        band.light(column, row) = {light.r * share, light.g * share, light.b * share, light.a};
      }
    }
  }
}

void render_opaque(const RenderJob& job, std::span<const ViewPosition> views,
                   std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrders orders = orders_for(job);
  const SplatOrder& order = orders.front();
  std::vector<std::vector<OpaqueBand>> bands(static_cast<std::size_t>(order.bands));
  for (int b = 0; b < order.bands; ++b)
    if (order.is_mine(b)) bands[b].assign(views.size(), OpaqueBand(0, job.rig.width, order.band_rows));
  OrderingMemory memory;
  for_each_ordered(job, projection_for(job, orders), window_around(job.scene, job.rig), orders, memory,
                   [&](const std::vector<SplatBlock>& blocks) {
                     for_each_band_of(order, [&](int b) {
                       for (std::size_t v = 0; v < views.size(); ++v)
                         for (int part = 0; part < order.parts; ++part)
                           for (const SplatBlock& block : blocks)
                             draw_spheres(block.bin(order.bin(b, part)), b * order.band_rows, views[v], bands[b][v]);
                     });
                   });
  for_each_band_of(order, [&](int b) {
    for (std::size_t v = 0; v < views.size(); ++v)
      tone_map_rows(bands[b][v], job.tone, b * order.band_rows, pictures[v]);
  });
  std::vector<ViewTarget> targets;
  for (const ImageView<Rgb8>& picture : pictures) targets.push_back({.picture = picture});
  share_bands(order, targets, false, job.ranks);
}

}  // namespace wheatstone
