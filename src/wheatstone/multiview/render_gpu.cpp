#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <vector>

#include "add_splats_source.h"
#include "finish_views_source.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {
namespace {

constexpr int most_views = 64;
/// As many particles as are copied at a time.
constexpr std::size_t particles_at_a_time = 1 << 20;

/// What add_splats.comp reads of its work: numbers of four bytes, without gaps.
struct SplatWork {
  std::int32_t particles = 0, views = 0, channels = 0, pictures = 0;
  std::array<std::int32_t, 9> column{};
  std::int32_t by_mass = 0, second_is_quantity = 0, own_colours = 0, logarithmic = 0, from_density = 0;
  std::int32_t by_length = 0, by_rank = 0, larger_if_denser = 0;
  std::array<float, 3> camera{}, right{}, down{}, forward{};
  float focal_px = 0, centre_x_px = 0, centre_y_px = 0, nearest_depth = 0, orthographic_nearness = 0;
  float first_w = 0, entries_per_w = 0;
  float mean_mass = 1, radius_factor = 0, fixed_radius = 0, quantity_scale = 1, log2_density_middle = 0, slope = 0,
        opacity = 0, least_opacity = 0;
  float smallest_px = 0, largest_px = 0, largest_mass_px = 0, size_depth = 0, palette_first = 0, palette_scale = 0;
  std::array<float, PictureTable::most> widest{}, scale{}, pad{};
  std::array<std::int32_t, PictureTable::most> width{}, rows{}, first_sum{};
  std::array<float, most_views> view{};
  std::array<float, ParallaxTable::size> parallax{}, parallax_step{};
  std::array<float, SplatStyle::palette_size> red{}, green{}, blue{};
};
static_assert(sizeof(SplatWork) % 4 == 0);

/// What finish_views.comp reads of its work.
struct FinishWork {
  std::int32_t views = 0, channels = 0, width = 0, rows = 0, pad = 0, first_sum = 0;
  std::int32_t smaller_width = 0, smaller_rows = 0;
  std::int32_t shown = 0;
  std::int32_t hues = 0, table_size = 0, stretch_size = 0, first_index = 0;
  float exposure = 0, scale = 0, offset = 0;
};

/// The pictures of every size (SplatOrder), and where their sums begin in the buffer of a group of views.
struct PictureSizes {
  SplatOrders orders;
  std::vector<int> width;
  int channels = 2;

  std::size_t pixels(std::size_t picture) const {
    return static_cast<std::size_t>(width[picture]) * orders[picture].rows;
  }
  std::size_t first_sum(std::size_t picture, int views) const {
    std::size_t sums = 0;
    for (std::size_t p = 0; p < picture; ++p) sums += pixels(p) * views * channels;
    return sums;
  }
  std::size_t sum_bytes(int views) const { return first_sum(orders.size(), views) * 2 * sizeof(std::uint32_t); }
};

PictureSizes sizes_of(const RenderJob& job) {
  PictureSizes sizes{.orders = orders_for(job.rig, job.scene.splat_style)};
  const Window view{.left = 0, .right = static_cast<float>(job.rig.width), .height = job.rig.height};
  for (const SplatOrder& order : sizes.orders) sizes.width.push_back(static_cast<int>(window_in(view, order).right));
  sizes.channels = job.tone.three_channels() ? 3 : 2;
  return sizes;
}

void set_camera(const Projection& projection, SplatWork& work) {
  const Camera& camera = projection.camera;
  work.camera = camera.position;
  work.right = camera.right;
  work.down = camera.down;
  work.forward = camera.forward;
  work.focal_px = camera.focal_px;
  work.centre_x_px = camera.centre_x_px;
  work.centre_y_px = camera.centre_y_px;
  work.nearest_depth = camera.nearest_depth;
  work.orthographic_nearness = camera.orthographic_depth > 0 ? 1 / camera.orthographic_depth : 0;
  work.first_w = projection.table.first_w;
  work.entries_per_w = projection.table.entries_per_w;
  std::ranges::copy(projection.table.value, work.parallax.begin());
  std::ranges::copy(projection.table.step, work.parallax_step.begin());
}

void set_style(const Projection& projection, SplatWork& work) {
  const SplatStyle& style = projection.splat_style;
  work.by_mass = style.look == Look::mass;
  work.second_is_quantity = style.colour_source == ColourSource::quantity;
  work.own_colours = style.colour_source == ColourSource::own;
  work.logarithmic = style.logarithmic;
  work.larger_if_denser = style.size_rule == SizeRule::denser_larger;
  work.mean_mass = style.mean_mass;
  work.radius_factor = style.radius_factor;
  work.fixed_radius = style.fixed_radius;
  work.quantity_scale = style.quantity_scale;
  work.log2_density_middle = style.log2_density_middle;
  work.slope = style.slope;
  work.opacity = style.opacity;
  work.least_opacity = style.least_opacity;
  work.smallest_px = style.smallest_px;
  work.largest_px = style.largest_px;
  work.largest_mass_px = projection.largest_mass_px;
  work.size_depth = style.size_depth;
  work.palette_first = style.palette_first;
  work.palette_scale = style.palette_scale;
  work.red = style.red;
  work.green = style.green;
  work.blue = style.blue;
}

/// The rules of sizes that depend on which columns a cloud has.
void set_size_rule(const Cloud& cloud, const SplatStyle& style, SplatWork& work) {
  const bool thesis = style.look == Look::thesis;
  const bool lengths = !cloud.smoothing_length.empty();
  work.by_rank =
      style.size_rule == SizeRule::denser_smaller || style.size_rule == SizeRule::denser_larger || (thesis && !lengths);
  work.by_length = style.size_rule == SizeRule::smoothing_length && lengths;
  work.from_density = !cloud.density.empty() && !thesis;
}

/// Colours as the shader unpacks them.
std::vector<std::uint32_t> packed_colours(const Cloud& cloud, ParticleRange range) {
  std::vector<std::uint32_t> packed;
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    const Rgb8 colour = cloud.colour[i];
    packed.push_back(colour.r | std::uint32_t{colour.g} << 8 | std::uint32_t{colour.b} << 16);
  }
  return packed;
}

/// Copies particles of a cloud to the buffer, column after column, and notes in the work where each begins.
void copy_columns(const Cloud& cloud, ParticleRange range, const SplatStyle& style, GpuBuffer& buffer,
                  SplatWork& work) {
  const std::vector<float> none;
  const std::vector<float>* second = &none;
  if (style.colour_source == ColourSource::quantity) second = &cloud.quantity;
  if (style.colour_source == ColourSource::temperature) second = &cloud.temperature;
  const std::array columns{&cloud.x,    &cloud.y,       &cloud.z, &cloud.density, second, &cloud.smoothing_length,
                           &cloud.mass, &cloud.presence};
  std::size_t next = 0;
  work.column.fill(-1);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c]->empty()) continue;
    work.column[c] = static_cast<std::int32_t>(next);
    buffer.write(std::span(*columns[c]).subspan(range.first, range.count), next * sizeof(float));
    next += range.count;
  }
  if (style.colour_source == ColourSource::own) {
    const std::vector<std::uint32_t> packed = packed_colours(cloud, range);
    work.column.back() = static_cast<std::int32_t>(next);
    buffer.write(std::span(packed), next * sizeof(float));
  }
  work.particles = static_cast<std::int32_t>(range.count);
  set_size_rule(cloud, style, work);
}

/// Views whose sums are one buffer.
struct ViewGroup {
  std::size_t first, count;
  GpuBuffer sums;
};

std::vector<ViewGroup> groups_for(const PictureSizes& sizes, std::size_t views, std::size_t largest_buffer) {
  const std::size_t fit = std::clamp<std::size_t>(largest_buffer / sizes.sum_bytes(1), 1, most_views);
  std::vector<ViewGroup> groups;
  for (std::size_t first = 0; first < views; first += fit) {
    const std::size_t count = std::min(fit, views - first);
    groups.push_back({first, count, GpuBuffer(sizes.sum_bytes(static_cast<int>(count)))});
  }
  return groups;
}

void set_views(const PictureSizes& sizes, std::span<const ViewPosition> views, SplatWork& work) {
  const int count = static_cast<int>(views.size());
  work.views = count;
  work.channels = sizes.channels;
  work.pictures = static_cast<int>(sizes.orders.size());
  const PictureTable table(sizes.orders);
  work.widest = table.widest;
  work.scale = table.scale;
  work.pad = table.pad;
  for (std::size_t p = 0; p < sizes.orders.size(); ++p) {
    work.width[p] = sizes.width[p];
    work.rows[p] = sizes.orders[p].rows;
    work.first_sum[p] = static_cast<std::int32_t>(sizes.first_sum(p, count));
  }
  std::ranges::transform(views, work.view.begin(), [](ViewPosition view) { return view - central_view; });
}

/// Adds every particle to every view: copied, projected and lit once.
void add_particles(const RenderJob& job, const PictureSizes& sizes, std::vector<ViewGroup>& groups) {
  const GpuProgram add_splats(add_splats_source);
  const SplatStyle& style = job.scene.splat_style;
  const Projection projection = projection_for(job, sizes.orders);
  SplatWork work;
  set_camera(projection, work);
  set_style(projection, work);
  GpuBuffer columns(work.column.size() * particles_at_a_time * sizeof(float));
  job.chunks([&](const Cloud& cloud) {
    for (std::size_t first = 0; first < cloud.size(); first += particles_at_a_time) {
      const ParticleRange range{first, std::min(particles_at_a_time, cloud.size() - first)};
      copy_columns(cloud, range, style, columns, work);
      for (ViewGroup& group : groups) {
        set_views(sizes, std::span(job.rig.positions).subspan(group.first, group.count), work);
        const GpuBuffer of_work(std::span<const SplatWork>(&work, 1));
        add_splats.run({groups_of(range.count, 64)}, {&of_work, &columns, &group.sums});
      }
    }
  });
}

/// The tables of the tone map, one after the other, as finish_views.comp reads them.
std::vector<std::int32_t> tables_of(const ToneMap& tone) {
  std::vector<std::int32_t> tables = tone.table;
  tables.insert(tables.end(), tone.stretch.begin(), tone.stretch.end());
  std::ranges::transform(tone.linear_stretch, std::back_inserter(tables),
                         [](float value) { return std::bit_cast<std::int32_t>(value); });
  tables.insert(tables.end(), tone.colours.begin(), tone.colours.end());
  return tables;
}

/// How the shader shows sums; 0 leaves them light.
std::int32_t shown_as(const ToneMap& tone) {
  if (tone.look == Look::thesis) return 1;
  if (tone.shown == Shown::colours) return 4;
  return tone.shown == Shown::mean ? 3 : 2;
}

FinishWork finish_work(const PictureSizes& sizes, const ToneMap& tone, std::size_t picture, int views) {
  FinishWork work{.views = views,
                  .channels = sizes.channels,
                  .width = sizes.width[picture],
                  .rows = sizes.orders[picture].rows,
                  .pad = sizes.orders[picture].pad,
                  .first_sum = static_cast<std::int32_t>(sizes.first_sum(picture, views)),
                  .shown = picture == 0 ? shown_as(tone) : 0,
                  .hues = tone.hues,
                  .table_size = ToneMap::table_size,
                  .stretch_size = ToneMap::stretch_size,
                  .first_index = ToneMap::first_index,
                  .exposure = tone.exposure,
                  .scale = tone.scale,
                  .offset = tone.offset};
  if (picture + 1 < sizes.orders.size()) {
    work.smaller_width = sizes.width[picture + 1];
    work.smaller_rows = sizes.orders[picture + 1].rows;
  }
  return work;
}

/// The colours of a group's views, from the smallest picture to the views' own.
std::vector<std::uint32_t> finished(const ViewGroup& group, const PictureSizes& sizes, const ToneMap& tone) {
  const GpuProgram finish_views(finish_views_source);
  const std::vector<std::int32_t> all_tables = tables_of(tone);
  const GpuBuffer tables(std::span<const std::int32_t>{all_tables});
  const GpuBuffer none(0);
  const GpuBuffer colours(sizes.pixels(0) * group.count * sizeof(std::uint32_t));
  std::vector<GpuBuffer> light;  // of smaller pictures, the smallest first
  for (std::size_t p = sizes.orders.size(); p-- > 0;) {
    const FinishWork work = finish_work(sizes, tone, p, static_cast<int>(group.count));
    const GpuBuffer of_work(std::span<const FinishWork>(&work, 1));
    GpuBuffer here(p > 0 ? sizes.pixels(p) * group.count * sizes.channels * sizeof(float) : 0);
    finish_views.run({groups_of(sizes.width[p], 64), static_cast<std::uint32_t>(sizes.orders[p].rows),
                      static_cast<std::uint32_t>(group.count)},
                     {&of_work, &group.sums, light.empty() ? &none : &light.back(), &here, &colours, &tables});
    light.push_back(std::move(here));
  }
  std::vector<std::uint32_t> pixels(sizes.pixels(0) * group.count);
  colours.read(std::span(pixels));
  return pixels;
}

void unpack(std::span<const std::uint32_t> pixels, ImageView<Rgb8> picture) {
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const std::uint32_t colour = pixels[static_cast<std::size_t>(y) * picture.width() + x];
      picture.row(y)[x] = {static_cast<std::uint8_t>(colour), static_cast<std::uint8_t>(colour >> 8),
                           static_cast<std::uint8_t>(colour >> 16)};
    }
}

}  // namespace

void render_gpu(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures) {
  on_gpu([&](const GpuFacts& facts) {
    const PictureSizes sizes = sizes_of(job);
    std::vector<ViewGroup> groups = groups_for(sizes, pictures.size(), facts.largest_buffer);
    add_particles(job, sizes, groups);
    for (const ViewGroup& group : groups) {
      const std::vector<std::uint32_t> pixels = finished(group, sizes, job.tone);
      for (std::size_t v = 0; v < group.count; ++v)
        unpack(std::span(pixels).subspan(v * sizes.pixels(0), sizes.pixels(0)), pictures[group.first + v]);
    }
  });
}

}  // namespace wheatstone
