#include "wheatstone/multiview/gathered_light_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

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

void number_bins(SplatOrders& orders) {
  std::size_t bins = 0;
  for (SplatOrder& order : orders) {
    order.first_bin = bins;
    bins += order.bins();
  }
}

int width_of(const SplatOrder& order, const Rig& rig) {
  return order.pad == 0 ? rig.width
                        : static_cast<int>(std::ceil(static_cast<float>(rig.width) * order.scale)) + 2 * order.pad + 1;
}

}  // namespace

SplatOrders orders_for(const Rig& rig, const SplatStyle& splat_style) {
  SplatOrders orders{order_of_view(rig)};
  if (splat_style.look == Look::mass) add_smaller(rig, orders);
  for (SplatOrder& order : orders) {
    order.spacing = 64;
    order.parts = static_cast<int>(static_cast<float>(width_of(order, rig)) / order.spacing) + 1;
  }
  number_bins(orders);
  return orders;
}

SplatOrders orders_by_plane(const Rig& rig, const SplatStyle& splat_style, const DepthPlanes& planes,
                            SliceFilter filter) {
  SplatOrders orders{order_of_view(rig)};
  if (splat_style.look == Look::mass) add_smaller(rig, orders);
  for (SplatOrder& order : orders) {
    order.within =
        filter == SliceFilter::centroid ? SplatOrder::Within::nearer_plane : SplatOrder::Within::nearest_plane;
    const auto steps = static_cast<float>(planes.parallaxes.size() - 1);
    order.parts = static_cast<int>(std::ceil(steps * order.scale)) + 1;
    order.first = planes.parallaxes.front();
    order.spacing = planes.spacing_px;
  }
  number_bins(orders);
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

GatheredLight::GatheredLight(const SplatOrders& orders, const Window& window, int targets) {
  for (const SplatOrder& order : orders) {
    const int count = targets > 0 ? targets : order.parts;
    const Window here = window_in(window, order);
    targets_.push_back(count);
    std::vector<LightBand>& light = light_.emplace_back();
    for (int b = 0; b < order.bands; ++b)
      for (int target = 0; target < count; ++target)
        light.emplace_back(static_cast<int>(here.left), static_cast<int>(here.right), order.band_rows, target);
  }
}

void GatheredLight::darken() {
  for (std::vector<LightBand>& bands : light_)
    tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t i) { bands[i].darken(); });
}

void for_each_ordered(const Chunks& chunks, const Projection& projection, const Window& window,
                      const SplatOrders& orders, const std::function<void(const std::vector<SplatBlock>&)>& take) {
  // Splats of so many particles are few beside the particles, and many beside the bands that they go to.
  constexpr std::size_t at_a_time = 1 << 19;
  chunks([&](const Cloud& cloud) {
    for (std::size_t first = 0; first < cloud.size(); first += at_a_time)
      take(order_splats(cloud, {first, std::min(at_a_time, cloud.size() - first)}, projection, window, orders));
  });
}

void for_each_band(const SplatOrders& orders, const std::function<void(std::size_t picture, int band)>& work) {
  for (std::size_t picture = 0; picture < orders.size(); ++picture)
    tbb::parallel_for(0, orders[picture].bands, [&](int band) { work(picture, band); });
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
  // What was added to the larger picture is not needed again.
  if (picture + 2 < orders_.size()) light_[picture + 2].clear();
  return targets;
}

}  // namespace wheatstone
