#include "wheatstone/multiview/front_to_back_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

#include "wheatstone/multiview/deal_out_internal.h"
#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {

FrontToBack::FrontToBack(int width, int rows, int top, ViewPosition view)
    : width_(width), rows_(rows), top_(top), view_(view), band_(0, width, rows, LightBand::most_channels) {
  for (int first = 0; first < width; first += block_columns)
    open_.push_back(std::min(block_columns, width - first) * rows);
}

bool FrontToBack::any_open(int first, int end) const {
  const auto* const blocks = open_.data();
  return std::any_of(blocks + first / block_columns, blocks + (end - 1) / block_columns + 1,
                     [](int open) { return open > 0; });
}

void FrontToBack::blend(const Splat& splat) {
  const float size = float_from_half(splat.size);
  const float reach = reach_of(size);
  const float x = std::fma(splat.parallax, view_ - central_view, splat.x) - 0.5f;
  const float y = splat.y - static_cast<float>(top_) - 0.5f;
  const int first_row = std::max(static_cast<int>(std::ceil(y - reach)), 0);
  const int end_row = std::min(static_cast<int>(std::floor(y + reach)) + 1, rows_);
  const int first = std::max(static_cast<int>(std::ceil(x - reach)), 0);
  const int end = std::min(static_cast<int>(std::floor(x + reach)) + 1, width_);
  if (first_row >= end_row || first >= end || !any_open(first, end)) return;

  const float variance = size * size / (diameters_a_deviation * diameters_a_deviation) + pixel_variance;
  const auto weight_at = [&](float distance) { return std::exp(-distance * distance / (2 * variance)); };
  std::array<float, 2 + static_cast<std::size_t>(SplatStyle::widest_px)> across;
  for (int column = first; column < end; ++column)
    across[static_cast<std::size_t>(column - first)] = weight_at(static_cast<float>(column) - x);
  std::uint32_t packed = 0;
  std::memcpy(&packed, splat.colour, sizeof packed);
  const std::array<float, 3> light = unpacked_light(packed);
  const float depth = float_from_half(splat.colour[2]);
  for (int row = first_row; row < end_row; ++row) {
    const float down = depth * weight_at(static_cast<float>(row) - y);
    float* pixel = band_.row(row) + first * LightBand::most_channels;
    for (int column = first; column < end; ++column, pixel += LightBand::most_channels) {
      const float through = 1 - pixel[3];
      if (through < full) continue;
      const float share = through * (1 - std::exp(-down * across[static_cast<std::size_t>(column - first)]));
      for (std::size_t channel = 0; channel < 3; ++channel) pixel[channel] += share * light[channel];
      pixel[3] += share;
      ++fragments_;
      if (1 - pixel[3] < full) --open_[static_cast<std::size_t>(column / block_columns)];
    }
  }
}

namespace {

/// A band's splats, the nearest first. Equally near splats keep their order.
std::vector<Splat> nearest_first(const std::vector<SplatBlock>& blocks, const SplatOrder& order, int band) {
  std::vector<Splat> splats;
  for (int part = 0; part < order.parts; ++part)
    for (const SplatBlock& block : blocks)
      std::ranges::copy(block.bin(order.bin(band, part)), std::back_inserter(splats));
  std::ranges::stable_sort(splats, {}, &Splat::parallax);
  return splats;
}

}  // namespace

void render_front_to_back(const RenderJob& job, std::span<const ViewPosition> views,
                          std::span<const ViewTarget> targets) {
  const SplatOrders orders = orders_for(job);
  const SplatOrder& order = orders.front();
  std::vector<SplatBlock> splats;
  OrderingMemory memory;
  for_each_ordered(job, projection_for(job, orders), window_around(job.scene, job.rig), orders, memory,
                   [&](std::vector<SplatBlock> blocks) { std::ranges::move(blocks, std::back_inserter(splats)); });
  for_each_band_of(order, [&](int b) {
    const std::vector<Splat> sorted = nearest_first(splats, order, b);
    const int top = b * order.band_rows;
    for (std::size_t v = 0; v < views.size(); ++v) {
      FrontToBack view(job.rig.width, std::min(order.band_rows, job.rig.height - top), top, views[v]);
      for (const Splat& splat : sorted) view.blend(splat);
      finish_band(view.band(), job.tone, top, targets[v]);
    }
  });
  share_bands(order, targets, false, job.ranks);
}

}  // namespace wheatstone
