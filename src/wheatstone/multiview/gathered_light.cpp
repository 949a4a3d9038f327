#include "wheatstone/multiview/gathered_light_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "wheatstone/multiview/deal_out_internal.h"

namespace wheatstone {
namespace {

SplatOrder order_of_view(const Rig& rig) {
  SplatOrder order;
  // A splat must not reach into more than two bands.
  static_assert(SplatStyle::widest_px + 2 <= 32 && widest_mass_px <= SplatStyle::widest_px);
  order.band_rows = 32;
  order.rows = rig.height;
  order.bands = (order.rows + order.band_rows - 1) / order.band_rows;
  return order;
}

/// Pictures of half the size each, until the widest splat that a view can show fits.
void add_smaller(const Rig& rig, SplatOrders& orders) {
  constexpr int pad = 2;
  const auto widest = static_cast<float>(std::max(rig.width, rig.height));
  while (widest_mass_px / orders.back().scale < widest && static_cast<int>(orders.size()) < PictureTable::most) {
    SplatOrder order = orders.back();
    order.scale /= 2;
    order.pad = pad;
    order.rows = static_cast<int>(std::ceil(static_cast<float>(rig.height) * order.scale)) + 2 * pad + 1;
    order.bands = (order.rows + order.band_rows - 1) / order.band_rows;
    orders.push_back(order);
  }
}

void number_bins(SplatOrders& orders, const Ranks& ranks) {
  std::size_t bins = 0;
  int bands = 0;
  for (SplatOrder& order : orders) {
    order.first_bin = bins;
    bins += order.bins();
    order.first_band = bands;
    bands += order.bands;
    order.rank = ranks.rank();
    order.ranks = ranks.count();
  }
}

int width_of(const SplatOrder& order, const Rig& rig) {
  return order.pad == 0 ? rig.width
                        : static_cast<int>(std::ceil(static_cast<float>(rig.width) * order.scale)) + 2 * order.pad + 1;
}

// Splats of so many particles are few beside the particles, and many beside the bands that they go to.
constexpr std::size_t particles_at_a_time = 1 << 19;

Cloud part_of(const Cloud& cloud, std::size_t first, std::size_t count) {
  Cloud part;
  for_each_column(part, cloud, [&](auto& to, const auto& from) {
    if (from.empty()) return;
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
    to.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  });
  part.origin = cloud.origin;
  part.box_size = cloud.box_size;
  return part;
}

}  // namespace

SplatOrders orders_for(const RenderJob& job) {
  SplatOrders orders{order_of_view(job.rig)};
  if (job.scene.splat_style.look == Look::mass) add_smaller(job.rig, orders);
  for (SplatOrder& order : orders) {
    order.spacing = 64;
    order.parts = static_cast<int>(static_cast<float>(width_of(order, job.rig)) / order.spacing) + 1;
  }
  number_bins(orders, job.ranks);
  return orders;
}

SplatOrders orders_by_plane(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter) {
  SplatOrders orders{order_of_view(job.rig)};
  if (job.scene.splat_style.look == Look::mass) add_smaller(job.rig, orders);
  for (SplatOrder& order : orders) {
    order.within =
        filter == SliceFilter::centroid ? SplatOrder::Within::nearer_plane : SplatOrder::Within::nearest_plane;
    const auto steps = static_cast<float>(planes.parallaxes.size() - 1);
    order.parts = static_cast<int>(std::ceil(steps * order.scale)) + 1;
    order.first = planes.parallaxes.front();
    order.spacing = planes.spacing_px;
  }
  number_bins(orders, job.ranks);
  return orders;
}

Projection projection_for(const RenderJob& job, const SplatOrders& orders, ViewPosition view) {
  Projection projection = make_projection(job.scene, job.statistics, view);
  projection.largest_mass_px = SplatStyle::widest_px / orders.back().scale;
  return projection;
}

Window window_in(const Window& window, const SplatOrder& order) {
  return {.left = std::floor(window.left * order.scale),
          .right = std::ceil(window.right * order.scale) + static_cast<float>(order.pad > 0 ? 2 * order.pad + 1 : 0),
          .height = order.rows};
}

GatheredLight::GatheredLight(const SplatOrders& orders, const Window& window, Deposit kind, int targets)
    : orders_(orders), window_(window), kind_(kind) {
  for (const SplatOrder& order : orders) {
    const int count = targets > 0 ? targets : order.parts;
    targets_.push_back(count);
    std::vector<LightBand>& light = light_.emplace_back(static_cast<std::size_t>(order.bands) * count);
    tbb::parallel_for(0, static_cast<int>(light.size()), [&](int i) {
      if (order.is_mine(i / count)) light[i] = dark_band(order, window, kind, i % count);
    });
  }
}

LightBand dark_band(const SplatOrder& order, const Window& window, Deposit kind, int number) {
  const Window here = window_in(window, order);
  return {static_cast<int>(here.left), static_cast<int>(here.right), order.band_rows, channels_in(kind), number};
}

void GatheredLight::move_to_first(const Ranks& ranks) {
  if (ranks.alone()) return;
  const auto for_each_of = [&](int owner, auto call) {
    for (std::size_t picture = 0; picture < orders_.size(); ++picture)
      for (int b = 0; b < orders_[picture].bands; ++b)
        for (int target = 0; orders_[picture].owner(b) == owner && target < targets_of(picture); ++target)
          call(orders_[picture], target, band(picture, b, target));
  };
  Ranks::Bytes mine;
  for_each_of(ranks.first() ? -1 : ranks.rank(), [&](const SplatOrder&, int, LightBand& band) {
    mine.push_back(std::byte{band.lit()});
    if (band.lit()) mine.insert(mine.end(), band.bytes().begin(), band.bytes().end());
    band = {};
  });
  const std::vector<Ranks::Bytes> all = ranks.to_first(mine);
  for (int rank = 1; ranks.first() && rank < ranks.count(); ++rank) {
    auto from = all[static_cast<std::size_t>(rank)].begin();
    for_each_of(rank, [&](const SplatOrder& order, int target, LightBand& band) {
      band = dark_band(order, window_, kind_, target);
      if (*from++ == std::byte{0}) return;
      const auto end = from + static_cast<std::ptrdiff_t>(band.bytes().size());
      std::copy(from, end, band.bytes().begin());
      band.note_light();
      from = end;
    });
  }
}

void GatheredLight::add(const GatheredLight& light) {
  for (std::size_t picture = 0; picture < light_.size(); ++picture)
    tbb::parallel_for(std::size_t{0}, light_[picture].size(),
                      [&](std::size_t i) { light_[picture][i].add(light.light_[picture][i]); });
}

Chunks chunks_of(const Cloud& cloud, const Ranks& ranks) {
  if (ranks.alone()) return [&cloud](const std::function<void(const Cloud&)>& visit) { visit(cloud); };
  return [&cloud, ranks](const std::function<void(const Cloud&)>& visit) {
    const std::size_t round = particles_at_a_time * static_cast<std::size_t>(ranks.count());
    for (std::size_t begin = 0; begin < cloud.size(); begin += round) {
      const std::size_t first =
          std::min(begin + particles_at_a_time * static_cast<std::size_t>(ranks.rank()), cloud.size());
      visit(part_of(cloud, first, std::min(particles_at_a_time, cloud.size() - first)));
    }
  };
}

void for_each_ordered(const RenderJob& job, const Projection& projection, const Window& window,
                      const SplatOrders& orders, OrderingMemory& memory,
                      const std::function<void(std::vector<SplatBlock>)>& take) {
  job.chunks([&](const Cloud& cloud) {
    std::vector<std::vector<SplatBlock>> ordered;
    for (std::size_t first = 0; first < cloud.size(); first += particles_at_a_time) {
      const ParticleRange range{first, std::min(particles_at_a_time, cloud.size() - first)};
      std::vector<SplatBlock> blocks = order_splats(cloud, range, projection, window, orders, memory);
      if (job.ranks.alone()) {
        take(std::move(blocks));
      } else {
        ordered.push_back(std::move(blocks));
      }
    }
    if (job.ranks.alone()) return;
    for (std::vector<SplatBlock>& blocks : deal_out(std::move(ordered), orders, job.ranks)) take(std::move(blocks));
  });
}

// Blocks drawn at a time, of at least 32 768 particles each: their splats take 6 MB.
constexpr std::size_t most_waiting = 8;

void WaitingBlocks::add(std::vector<SplatBlock> blocks) {
  std::ranges::move(blocks, std::back_inserter(blocks_));
  if (blocks_.size() >= most_waiting) finish();
}

void WaitingBlocks::finish() {
  if (!blocks_.empty()) draw_(blocks_);
  give_back();
}

void WaitingBlocks::give_back() {
  // Other ranks' blocks come, too: not all are needed again.
  for (SplatBlock& block : blocks_)
    if (memory_.spare.size() < most_waiting) memory_.spare.push_back(std::move(block));
  blocks_.clear();
}

void for_each_band_of(const SplatOrder& order, const std::function<void(int band)>& work) {
  tbb::parallel_for(0, order.bands, [&](int band) {
    if (order.is_mine(band)) work(band);
  });
}

void for_each_band(const SplatOrders& orders, const std::function<void(std::size_t picture, int band)>& work) {
  for (std::size_t picture = 0; picture < orders.size(); ++picture)
    for_each_band_of(orders[picture], [&](int band) { work(picture, band); });
}

ViewPyramid::ViewPyramid(const SplatOrders& orders, const Rig& rig, std::size_t views, bool three_channels)
    : orders_(orders), rig_(rig), three_channels_(three_channels), views_(views), light_(orders.size()) {}

std::vector<ViewTarget> ViewPyramid::targets(std::size_t picture, std::span<const ImageView<Rgb8>> pictures) {
  const SplatOrder& order = orders_[picture];
  const bool stays_light = picture > 0 || pictures.empty();
  if (stays_light)
    light_[picture].assign(views_, ViewLight(width_of(order, rig_), order.rows, three_channels_ ? 3 : 2));
  std::vector<ViewTarget> targets(views_);
  for (std::size_t v = 0; v < views_; ++v) {
    ViewTarget& target = targets[v];
    target.pad = order.pad;
    if (picture + 1 < orders_.size()) target.smaller = &light_[picture + 1][v];
    if (stays_light) {
      target.light = &light_[picture][v];
    } else {
      target.picture = pictures[v];
    }
  }
  // Light that was added to the larger picture is not needed again.
  if (picture + 2 < orders_.size()) light_[picture + 2].clear();
  return targets;
}

void ViewPyramid::share(std::size_t picture, std::span<const ViewTarget> targets, const Ranks& ranks) const {
  share_bands(orders_[picture], targets, picture > 0, ranks);
}

}  // namespace wheatstone
