#include "wheatstone/app/render_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "wheatstone/app/particle_chunks_internal.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/error.h"
#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/particles/cloud_statistics.h"
#include "wheatstone/particles/sph_density.h"
#include "wheatstone/particles/unit_expression.h"

namespace wheatstone {
namespace {

/// The scene as the central camera has it.
struct Staged {
  Scene scene;
  Rig rig;
  ViewingGeometry viewing;
};

Staged stage(const RenderParticlesOptions& options, const CloudStatistics& statistics) {
  Rig rig = options.positions.empty() ? evenly_spaced(options.width, options.height, options.views, options.span)
                                      : Rig{options.width, options.height, options.positions};
  return {scene_of(statistics, options), std::move(rig), viewing_of(options)};
}

/// The middle of a box or sphere; nothing where there is neither.
template <class Region>
std::optional<std::array<double, 3>> middle_of(const Region& region) {
  if (const Sphere* sphere = std::get_if<Sphere>(&region)) return sphere->centre;
  const Box* box = std::get_if<Box>(&region);
  if (box == nullptr) return std::nullopt;
  std::array<double, 3> middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = box->lower[axis] / 2 + box->upper[axis] / 2;
  return middle;
}

/// One unit of the tone map's limits, in units of the shown values.
float unit_of_tone(const Scene& scene) {
  return scene.splat_style.colour_source == ColourSource::quantity ? 1 / scene.splat_style.quantity_scale
                                                                   : column_of_light(scene);
}

/// Sets up what is shown instead of the usual picture, and the limits in units of light.
void show_quantity(const RenderParticlesOptions& options, const CloudStatistics& statistics, Scene& scene,
                   ToneSettings& tone) {
  if (options.appearance.look == Look::thesis) return;
  tone.colour_map = options.appearance.colour_map;
  const UsualColours usual = usual_colours(Look::mass);
  tone.cold = options.appearance.cold.value_or(usual.cold);
  tone.hot = options.appearance.hot.value_or(usual.hot);
  if (options.quantity == "column-density") {
    tone.shown = Shown::column;
    // Particles with colours of their own have a mass, too.
    if (scene.splat_style.colour_source == ColourSource::own) scene.splat_style.colour_source = ColourSource::density;
  } else if (!options.quantity.empty()) {
    tone.shown = Shown::mean;
    scene.splat_style.colour_source = ColourSource::quantity;
    scene.splat_style.quantity_scale = statistics.largest_quantity > 0 ? 1 / statistics.largest_quantity : 1;
  }
  const float unit = unit_of_tone(scene);
  tone.least = options.least / unit;
  tone.most = options.most / unit;
}

/// The views from the slices that were made.
void draw_slices(const RenderParticlesOptions& options, RenderedParticles& result, const Progress& progress) {
  result.rendered.method = Method::layered;
  result.rendered.reason = "layered: slices are asked for";
  result.rendered.planes = static_cast<int>(result.stack.slices.size());
  result.rendered.exposure = result.stack.tone.exposure;
  result.rendered.tone = result.stack.tone;
  if (!options.without_views && options.rendering.ranks.first())
    result.rendered.views =
        render_slices(result.stack, result.rig, options.rendering.filter, progress, options.rendering.focus);
}

void note_what_is_missing(const CloudStatistics& statistics, const RenderParticlesOptions& options,
                          RenderedParticles& result) {
  const bool mass = options.appearance.look == Look::mass;
  if (mass && (options.values || options.quantity == "column-density") && !options.framing.orthographic)
    result.warnings.emplace_back(
        "in perspective a column density counts per area at the depth that is looked at; --projection orthographic "
        "gives it in the units of the file");
  if (mass && !options.quantity.empty() && !statistics.has_mass)
    result.warnings.emplace_back("the file has no masses: each particle counts 1");
}

/// Particles of which all is known.
struct KnownParticles {
  const Chunks& chunks;
  const CloudStatistics& statistics;
  const SelectionCounts& counts;
};

RenderedParticles render_known(const KnownParticles& particles, const RenderParticlesOptions& options,
                               const Progress& progress) {
  const auto& [chunks, statistics, counts] = particles;
  RenderedParticles result;
  result.particles = statistics.count;
  result.unchosen = counts.unchosen;
  result.dropped = counts.dropped;
  result.weightless = counts.weightless;
  result.mended = counts.mended;
  result.extreme = counts.extreme;
  result.has_mass = statistics.has_mass;
  result.types = options.choice.type_colours;
  Staged staged = stage(options, statistics);
  RenderOptions rendering = options.rendering;
  show_quantity(options, statistics, staged.scene, rendering.tone);
  result.rig = staged.rig;
  result.viewing = staged.viewing;
  result.focus = options.rendering.focus;
  bool first_pass = true;
  const Chunks counted = [&](const std::function<void(const Cloud&)>& visit) {
    particles.chunks([&](const Cloud& chunk) {
      if (first_pass) result.outside += count_outside(chunk, *particles.statistics.framed);
      visit(chunk);
    });
    first_pass = false;
  };
  if (options.slices) {
    report(progress, "slices", 0);
    SliceMaker maker(staged.scene, statistics, staged.rig, rendering);
    counted([&](const Cloud& chunk) { maker.add(chunk); });
    result.stack = maker.finish(staged.viewing);
    draw_slices(options, result, progress);
  } else {
    result.rendered = render(counted, statistics, staged.scene, staged.rig, rendering, progress);
  }
  if (options.values)
    result.values = view_values(chunks, statistics, staged.scene, staged.rig, options.rendering.ranks);
  const std::vector<std::uint64_t> outside = options.rendering.ranks.from_all(result.outside);
  result.outside = std::accumulate(outside.begin(), outside.end(), std::uint64_t{0});
  const float unit = unit_of_tone(staged.scene);
  result.least = result.rendered.tone.least * unit;
  result.most = result.rendered.tone.most * unit;
  result.scene = std::move(staged.scene);
  return result;
}

RenderedParticles render_surveyed(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                  const Progress& progress) {
  SurveyedParticles surveyed = survey(file, options, progress);
  if (surveyed.density == DensitySource::neighbours) {
    surveyed = {};
    return render_ready(read_particles(file, options, progress), options, progress);
  }
  const Chunks chunks = chunks_from(surveyed, file, options, progress);
  RenderedParticles result = render_known({chunks, surveyed.statistics, surveyed.counts}, options, progress);
  result.density = surveyed.density;
  note_what_is_missing(surveyed.statistics, options, result);
  return result;
}

/// The unit that a file tells for a quantity.
std::string unit_of(const CloudSource& source, const std::string& name, std::string otherwise) {
  for (const auto& [known, unit] : source.units)
    if (known == name) return unit_expression(unit);
  return otherwise;
}

}  // namespace

ShownUnits units_of(const CloudSource& source, const RenderParticlesOptions& options, bool has_mass) {
  ShownUnits units;
  units.length = unit_of(source, "length", unit_of(source, "x", "code_length"));
  const std::string name = quantity_name_of(options.quantity);
  if (name.empty()) {
    units.name = "column density";
    units.value = column_unit(has_mass ? unit_of(source, "mass", "code_mass") : "particles", units.length);
  } else {
    units.name = name;
    units.value = unit_of(source, name, name == "temperature" ? "K" : "code_unit");
  }
  return units;
}

ReadyParticles ready_particles(Cloud cloud, const std::filesystem::path& file, const RenderParticlesOptions& options,
                               const Progress& progress) {
  check_render_options(options);
  ReadyParticles ready{.cloud = std::move(cloud)};
  put_quantity(ready.cloud, file, options.quantity);
  ready.counts = select_particles(ready.cloud, options.selection);
  if (ready.cloud.size() == 0) refuse_nothing(file, options, ready.counts);
  check_positions(file, ready.cloud);
  if (ready.cloud.density.empty() && !has_colours_of_file(ready.cloud, options)) {
    estimate_density(ready.cloud, options.neighbours, progress, options.rendering.ranks);
    ready.density = DensitySource::neighbours;
  }
  if (options.appearance.shine > 0) ready.statistics.grid = std::make_shared<DensityGrid>();
  ready.statistics.add(ready.cloud);
  if (ready.statistics.grid != nullptr) ready.statistics.grid->finish(options.neighbours);
  ready.statistics.framed = framed_region(ready.statistics, options.fit);
  return ready;
}

ReadyParticles read_particles(const std::filesystem::path& file, const RenderParticlesOptions& options,
                              const Progress& progress) {
  check_render_options(options);
  return ready_particles(read_cloud(file, choice_of(options), progress), file, options, progress);
}

Brightness brightness_for(const CloudStatistics& statistics, const RenderParticlesOptions& options) {
  Staged staged = stage(options, statistics);
  RenderOptions rendering = options.rendering;
  show_quantity(options, statistics, staged.scene, rendering.tone);
  const ToneSettings tone = tone_found(statistics, staged.scene, staged.rig, rendering);
  const float unit = unit_of_tone(staged.scene);
  return {.exposure = tone.exposure, .least = tone.least * unit, .most = tone.most * unit};
}

// The point that the camera looks at is left out: a window that looks elsewhere keeps its cloud and shows the same
// picture.
CloudChoice choice_of(const RenderParticlesOptions& options) {
  CloudChoice choice = options.choice;
  const std::string quantity = quantity_name_of(options.quantity);
  if (quantity != "temperature" && quantity != "density") choice.quantity = quantity;
  for (const std::optional<std::array<double, 3>>& middle :
       {options.selection.centre, middle_of(options.fit), middle_of(options.selection.cut)})
    if (middle && !choice.origin) choice.origin = middle;
  return choice;
}

ViewingGeometry viewing_of(const RenderParticlesOptions& options) {
  ViewingGeometry viewing = options.depth.viewing;
  viewing.width_px = options.width;
  return viewing;
}

StagedCamera staged_camera(const std::array<float, 3>& centre, float radius, const std::array<double, 3>& origin,
                           const RenderParticlesOptions& options) {
  Framing framing = options.framing;
  if (options.look_at) {
    framing.look_at.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis)
      (*framing.look_at)[axis] = static_cast<float>((*options.look_at)[axis] - origin[axis]);
  }
  const Camera camera = camera_around(centre, radius, options.width, options.height, framing);
  const auto depth_of = [&camera](const std::array<float, 3>& point) {
    float depth = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) depth += (point[axis] - camera.position[axis]) * camera.forward[axis];
    return depth;
  };
  const float distance = depth_of(framing.look_at.value_or(centre));
  // A camera that looks at a point far from the scene may stand within it, or before all of it.
  const float depth = std::max(depth_of(centre), distance * 0.01f);
  // In single precision, what is so far away has one depth.
  constexpr float farthest = 1e4f;
  if (!(std::abs(depth_of(centre)) <= farthest * radius) || !(std::abs(distance) <= farthest * radius))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("look-at: lies {} from the middle of the scene, expected at most {}, {} times its radius",
                            std::abs(depth_of(centre) - distance), farthest * radius, farthest));
  return {camera, mapping_for(options.depth, options.width, std::max(depth - radius, depth * 0.01f), depth + radius),
          distance};
}

std::vector<std::string> discomforts_of(const RenderParticlesOptions& options) {
  const bool regions = !options.depth.regions.empty();
  float nearest = regions ? options.depth.regions.front().behind_mm : -options.depth.near_mm;
  float farthest = regions ? options.depth.regions.back().behind_mm : options.depth.far_mm;
  for (const PerceivedDepth::Region& region : options.depth.regions) {
    nearest = std::min(nearest, region.behind_mm);
    farthest = std::max(farthest, region.behind_mm);
  }
  return discomforts(viewing_of(options), -nearest, farthest);
}

Scene scene_of(const CloudStatistics& statistics, const RenderParticlesOptions& options) {
  StagedCamera staged = staged_camera(statistics.centre(), statistics.radius(), statistics.origin, options);
  Scene scene{.camera = staged.camera, .mapping = std::move(staged.mapping)};
  scene.splat_style = make_splat_style(options.appearance, statistics);
  scene.splat_style.size_depth = staged.distance;
  const ViewingGeometry& viewing = options.depth.viewing;
  scene.shine = {.strength = options.appearance.shine,
                 .turn = viewing.eye_separation_mm / viewing.viewing_distance_mm,
                 .grid = statistics.grid};
  return scene;
}

float usual_depth_mm(float screen_width_mm) { return std::min(100.f, 0.27f * screen_width_mm); }

DepthMapping mapping_for(const PerceivedDepth& depth, int width_px, float nearest, float farthest) {
  ViewingGeometry viewing = depth.viewing;
  viewing.width_px = width_px;
  if (depth.regions.empty()) return single_region(nearest, farthest, viewing, depth.near_mm, depth.far_mm);
  std::vector<PlacedDepth> placed;
  for (const PerceivedDepth::Region& region : depth.regions)
    placed.push_back({nearest + region.share * (farthest - nearest), region.behind_mm});
  const DepthMapping mapping = many_regions(placed, viewing);
  return depth.smooth ? monotone_curve(mapping) : mapping;
}

RenderedParticles render_ready(const ReadyParticles& particles, const RenderParticlesOptions& options,
                               const Progress& progress) {
  check_render_options(options);
  const Chunks chunks = chunks_of(particles.cloud, options.rendering.ranks);
  RenderedParticles result = render_known({chunks, particles.statistics, particles.counts}, options, progress);
  result.density = particles.density;
  note_what_is_missing(particles.statistics, options, result);
  return result;
}

RenderedParticles render_particles(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                   const Progress& progress) {
  check_render_options(options);
  make_splat_style(options.appearance, {});  // what makes no sense is said before the long work
  const CloudSource source = open_cloud(file, options.choice);
  if (options.selection.centre && !(source.box_size > 0))
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no periodic box, which a centre needs", file.string()));
  RenderedParticles result = render_surveyed(file, options, progress);
  result.format = source.format;
  result.redshift = source.redshift;
  if (!source.redshift) result.time = source.time;
  result.units = units_of(source, options, result.has_mass);
  for (std::string& warning : discomforts_of(options)) result.warnings.push_back(std::move(warning));
  return result;
}

}  // namespace wheatstone
