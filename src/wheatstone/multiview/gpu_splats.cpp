#include "wheatstone/multiview/gpu_splats_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "light_of_sums_source.h"
#include "project_splats_source.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/program.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/gpu_lists_internal.h"
#include "wheatstone/multiview/shine_internal.h"

namespace wheatstone {
namespace {

/// The parameters of programs that project (project_splats.comp): numbers of four bytes, in groups of four.
struct SplatWork {
  std::int32_t particles = 0, pictures = 0;
  std::int32_t second_is_quantity = 0, own_colours = 0, logarithmic = 0, from_density = 0;
  std::int32_t by_length = 0, by_rank = 0, larger_if_denser = 0;
  float first_w = 0, entries_per_w = 0;
  float diameters = 0, spread = 0;
  float orthographic_nearness = 0, mean_mass = 1, radius_factor = 0, fixed_radius = 0, quantity_scale = 1,
        log2_density_middle = 0, slope = 0;
  float opacity = 0, least_opacity = 0, smallest_px = 0, largest_px = 0, largest_mass_px = 0, size_depth = 0,
        palette_first = 0, palette_scale = 0;
  std::array<float, 4> camera{}, right{}, down{}, forward{};
  std::array<std::int32_t, 12> column{};
  std::array<std::array<float, 4>, PictureTable::most> fits{};
};
static_assert(sizeof(SplatWork) == 4 * 28 + 16 * (4 + 3 + PictureTable::most));

/// Columns of a cloud that a program reads.
constexpr std::size_t most_columns = 9;

/// Three numbers and a fourth.
std::array<float, 4> four(const std::array<float, 3>& three, float fourth) {
  return {three[0], three[1], three[2], fourth};
}

void set_camera(const Projection& projection, SplatWork& work) {
  const Camera& camera = projection.camera;
  work.camera = four(camera.position, camera.focal_px);
  work.right = four(camera.right, camera.centre_x_px);
  work.down = four(camera.down, camera.centre_y_px);
  work.forward = four(camera.forward, camera.nearest_depth);
  work.orthographic_nearness = camera.orthographic_depth > 0 ? 1 / camera.orthographic_depth : 0;
  work.first_w = projection.table.first_w;
  work.entries_per_w = projection.table.entries_per_w;
}

void set_style(const Projection& projection, SplatWork& work) {
  const SplatStyle& style = projection.splat_style;
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
  work.diameters = mass_diameters(style.kernel) * deviations_a_radius;
  work.spread = 0.2f * mass_diameters(style.kernel) * mass_diameters(style.kernel);
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

/// The columns of a cloud that programs read, in their order, but for colours.
std::array<const std::vector<float>*, 8> columns_of(const Cloud& cloud, const SplatStyle& style) {
  static const std::vector<float> none;
  const std::vector<float>* second = &none;
  if (style.colour_source == ColourSource::quantity) second = &cloud.quantity;
  if (style.colour_source == ColourSource::temperature) second = &cloud.temperature;
  return {&cloud.x, &cloud.y, &cloud.z, &cloud.density, second, &cloud.smoothing_length, &cloud.mass, &cloud.presence};
}

/// Where each column begins in a buffer that has room for `most_gathered` particles in each.
decltype(SplatWork::column) places_of(const Cloud& cloud, const SplatStyle& style) {
  decltype(SplatWork::column) places;
  places.fill(-1);
  const auto columns = columns_of(cloud, style);
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (!columns[c]->empty()) places[c] = static_cast<std::int32_t>(c * most_gathered);
  if (style.colour_source == ColourSource::own)
    places[columns.size()] = static_cast<std::int32_t>(columns.size() * most_gathered);
  return places;
}

/// Copies particles of a cloud to the buffer, behind so many.
void copy_columns(const Cloud& cloud, ParticleRange range, const SplatStyle& style, std::size_t behind,
                  GpuBuffer& buffer) {
  const auto columns = columns_of(cloud, style);
  const auto at = [&](std::size_t c) { return (c * most_gathered + behind) * sizeof(float); };
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (!columns[c]->empty()) buffer.write(std::span(*columns[c]).subspan(range.first, range.count), at(c));
  if (style.colour_source != ColourSource::own) return;
  const std::vector<std::uint32_t> packed = packed_colours(cloud, range);
  buffer.write(std::span(packed), at(columns.size()));
}

void set_pictures(const SplatOrders& orders, SplatWork& work) {
  work.pictures = static_cast<std::int32_t>(orders.size());
  const PictureTable table(orders);
  for (std::size_t p = 0; p < PictureTable::most; ++p) work.fits[p] = {table.widest[p], table.scale[p], table.pad[p]};
}

/// The tables of programs that project: the parallaxes, the palette, and the light of encoded bytes.
GpuBuffer projection_tables(const Projection& projection) {
  std::vector<std::array<float, 4>> tables;
  for (std::size_t i = 0; i < projection.table.value.size(); ++i)
    tables.push_back({projection.table.value[i], projection.table.step[i]});
  const SplatStyle& style = projection.splat_style;
  for (std::size_t i = 0; i < SplatStyle::palette_size; ++i)
    tables.push_back({style.red[i], style.green[i], style.blue[i], linear_from_srgb(static_cast<std::uint8_t>(i))});
  return GpuBuffer(std::span<const std::array<float, 4>>(tables));
}

/// The input of light_of_sums.comp.
enum Gathered : std::int32_t { sums_of_steps = 0, nearest_discs = 1, other_light = 2 };

/// Sums, or the nearest discs, as floats.
GpuBuffer light_of(const GpuBuffer& sums, GpuTargets targets) {
  const std::size_t values = sums.bytes() / sum_bytes;
  GpuBuffer light = GpuBuffer::of_any_bytes(values * sizeof(float));
  const auto [columns, rows] = rows_of_groups(values, 64);
  kept_program(light_of_sums_source, {{"FROM", targets == GpuTargets::discs_in_views ? nearest_discs : sums_of_steps}})
      .run({columns, rows}, {&sums, &light});
  return light;
}

}  // namespace

GpuPictures gpu_pictures(const SplatOrders& orders, const Window& window, int channels) {
  GpuPictures pictures{.orders = orders, .left = {}, .width = {}, .targets = {}, .channels = channels};
  for (const SplatOrder& order : orders) {
    const Window here = window_in(window, order);
    pictures.left.push_back(static_cast<int>(here.left));
    pictures.width.push_back(static_cast<int>(here.right - here.left));
    pictures.targets.push_back(order.parts);
  }
  return pictures;
}

std::vector<TargetGroup> groups_of_targets(const GpuPictures& pictures, std::size_t most_values) {
  std::vector<TargetGroup> groups;
  const auto begin_group = [&] {
    groups.push_back({.first = std::vector<int>(pictures.size()),
                      .end = std::vector<int>(pictures.size()),
                      .base = std::vector<int>(pictures.size())});
  };
  begin_group();
  if (pictures.values(0) > most_values)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("graphics processor: a view of {} pixels does not fit into one of its buffers of {} MB; "
                            "--device cpu has no such limit",
                            pictures.pixels(0), most_values * sum_bytes >> 20));
  for (std::size_t p = 0; p < pictures.size(); ++p)
    for (int target = 0; target < pictures.targets[p]; ++target) {
      if (groups.back().values > 0 && groups.back().values + pictures.values(p) > most_values) begin_group();
      TargetGroup& group = groups.back();
      if (group.first[p] == group.end[p]) {
        group.first[p] = target;
        group.base[p] = static_cast<int>(group.values) - target * static_cast<int>(pictures.values(p));
      }
      group.end[p] = target + 1;
      group.values += pictures.values(p);
    }
  return groups;
}

namespace {

/// Projects particles and gathers them.
class ParticleGatherer {
 public:
  ParticleGatherer(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures, GpuTargets targets,
                   std::span<const ViewPosition> views, std::span<const TargetGroup> groups, GpuWritten written)
      : job_(job),
        tables_(projection_tables(projection_for(job, pictures.orders))),
        columns_(GpuBuffer::of_any_bytes(most_columns * most_gathered * sizeof(float))),
        gatherer_(job, facts, pictures, targets, views, groups, written) {
    const Projection projection = projection_for(job, pictures.orders);
    set_camera(projection, work_);
    set_style(projection, work_);
    set_pictures(pictures.orders, work_);
  }

  /// Keeps particles of a cloud until they are gathered, as many as there is room for. Returns how many.
  std::size_t keep(const Cloud& cloud, std::size_t first) {
    const SplatStyle& style = job_.scene.splat_style;
    if (const auto places = places_of(cloud, style); places != work_.column) {
      gather_kept();  // clouds may have different columns
      work_.column = places;
      set_size_rule(cloud, style, work_);
    }
    const ParticleRange range{first, std::min(most_gathered - kept_, cloud.size() - first)};
    copy_columns(cloud, range, style, kept_, columns_);
    kept_ += range.count;
    return range.count;
  }
  /// Adds some of what is kept to the targets. False where their lists do not fit into a buffer.
  bool gather(ParticleRange range) {
    SplatWork work = work_;
    work.particles = static_cast<std::int32_t>(range.count);
    for (std::int32_t& column : work.column)
      if (column >= 0) column += static_cast<std::int32_t>(range.first);
    const GpuBuffer of_work(std::span<const SplatWork>(&work, 1));
    kept_program(project_splats_source, {{"KIND_OF_LIGHT", job_.scene.splat_style.look == Look::mass ? 1 : 0}})
        .run({groups_of(range.count, 64)}, {&of_work, &columns_, &gatherer_.splats(), &gatherer_.reaches()},
             {&tables_});
    return gatherer_.add(range.count, target_);
  }
  /// Adds all of a cloud to all targets, or to one, sooner or later.
  void add_all(const Cloud& cloud, std::optional<int> target = {}) {
    if (target != target_) gather_kept();
    target_ = target;
    for (std::size_t first = 0; first < cloud.size(); first += keep(cloud, first))
      if (kept_ == most_gathered) gather_kept();
  }
  std::vector<GpuBuffer> gathered() && {
    gather_kept();
    return std::move(gatherer_).gathered();
  }

 private:
  const RenderJob& job_;
  SplatWork work_;
  GpuBuffer tables_, columns_;
  std::size_t kept_ = 0;       ///< particles in the columns
  std::optional<int> target_;  ///< theirs
  SplatGatherer gatherer_;

  void gather_kept() {
    std::size_t most = kept_;
    for (std::size_t first = 0; first < kept_;) {
      const ParticleRange range{first, std::min(most, kept_ - first)};
      if (gather(range)) {
        first += range.count;
      } else {
        most = (range.count + 1) / 2;  // wide splats stand in many lists
      }
    }
    kept_ = 0;
  }
};

/// Adds one light to another of the same groups.
void add_light(const std::vector<GpuBuffer>& more, const std::vector<GpuBuffer>& to) {
  for (std::size_t g = 0; g < to.size(); ++g) {
    const auto [columns, rows] = rows_of_groups(to[g].bytes() / sizeof(float), 64);
    kept_program(light_of_sums_source, {{"FROM", other_light}}).run({columns, rows}, {&more[g], &to[g]});
  }
}

std::vector<GpuBuffer> light_of(const std::vector<GpuBuffer>& sums, GpuTargets targets) {
  std::vector<GpuBuffer> light;
  for (const GpuBuffer& of_group : sums) light.push_back(light_of(of_group, targets));
  return light;
}

}  // namespace

LightOnGpu light_on_gpu(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures, GpuTargets targets,
                        std::span<const ViewPosition> views) {
  const bool shines = job.scene.shine.lit() && targets == GpuTargets::views;
  // Light that is gathered all at once needs no sums.
  if (job.statistics.count <= most_gathered && !shines) {
    LightOnGpu at_once{groups_of_targets(pictures, facts.largest_buffer / sizeof(float)), {}};
    ParticleGatherer gatherer(job, facts, pictures, targets, views, at_once.groups, GpuWritten::light);
    bool all = false;
    job.chunks([&](const Cloud& cloud) {
      if (cloud.size() == job.statistics.count) all = gatherer.gather({0, gatherer.keep(cloud, 0)});
    });
    if (all) {
      at_once.light = std::move(gatherer).gathered();
      return at_once;
    }
  }
  LightOnGpu light{groups_of_targets(pictures, facts.largest_buffer / sum_bytes), {}};
  ParticleGatherer gatherer(job, facts, pictures, targets, views, light.groups, GpuWritten::sums);
  std::optional<ParticleGatherer> highlights;
  if (shines) highlights.emplace(job, facts, pictures, targets, views, light.groups, GpuWritten::more_sums);
  // Few particles have highlights: only these are gathered again, for each view on its own.
  for_each_chunk_and_highlights(
      job, shines ? views : std::span<const ViewPosition>(), [&](const Cloud& chunk) { gatherer.add_all(chunk); },
      [&](const Cloud& shining, std::size_t view) { highlights->add_all(shining, static_cast<int>(view)); });
  light.light = light_of(std::move(gatherer).gathered(), targets);
  if (shines) add_light(light_of(std::move(*highlights).gathered(), targets), light.light);
  return light;
}

}  // namespace wheatstone
