#include "wheatstone/app/render_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "wheatstone/depth/comfort.h"
#include "wheatstone/error.h"
#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/particles/cloud_statistics.h"
#include "wheatstone/particles/sph_density.h"

namespace wheatstone {
namespace {

/// The scene as the central camera has it.
struct Staged {
  Scene scene;
  Rig rig;
  ViewingGeometry viewing;
};

Staged stage(const RenderParticlesOptions& options, const CloudStatistics& statistics) {
  return {scene_of(statistics, options), evenly_spaced(options.width, options.height, options.views, options.span),
          viewing_of(options)};
}

[[noreturn]] void refuse_nothing(const std::filesystem::path& file, const SelectionCounts& counts) {
  throw Error(ErrorKind::bad_input,
              counts.dropped > 0
                  ? fmt::format("{}: no particles to draw, {} have no finite position", file.string(), counts.dropped)
                  : fmt::format("{}: no particles to draw, no particle is inside the selected region", file.string()));
}

void check_positions(const std::filesystem::path& file, const Cloud& cloud) {
  constexpr float largest = Cloud::farthest_drawn;
  for (const std::vector<float>* axis : {&cloud.x, &cloud.y, &cloud.z})
    for (const float value : *axis)
      if (!(std::abs(value) <= largest))
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}: has a particle at {:g}, expected positions of at most {:g}", file.string(),
                                cloud.farthest != 0 ? cloud.farthest : static_cast<double>(value), largest));
}

void add(SelectionCounts& sum, const SelectionCounts& more) {
  sum.dropped += more.dropped;
  sum.mended += more.mended;
  sum.extreme += more.extreme;
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

/// Calls `visit` with every chunk of the file that has something selected in it.
template <class Visit>
SelectionCounts for_each_chunk(const std::filesystem::path& file, const RenderParticlesOptions& options,
                               const std::string& step, const Progress& progress, Visit visit) {
  const CloudSource source = open_cloud(file, choice_of(options));
  // The next chunk is read while this one is worked on.
  const auto read_next = [&] { return std::async(std::launch::async, [&] { return source.next(options.chunk); }); };
  std::future<Cloud> pending = read_next();
  SelectionCounts counts;
  std::uint64_t first = 0;
  while (true) {
    Cloud chunk = pending.get();
    const std::size_t read = chunk.size();
    if (read == 0) return counts;
    pending = read_next();
    add(counts, select_particles(chunk, options.selection, first));
    check_positions(file, chunk);
    first += read;
    if (chunk.size() > 0) visit(chunk);
    if (source.count) report(progress, step, static_cast<double>(first) / static_cast<double>(*source.count));
  }
}

/// The views from the slices that were made.
void draw_slices(const RenderParticlesOptions& options, const std::string& reason, RenderedParticles& result,
                 const Progress& progress) {
  result.rendered.method = Method::layered;
  result.rendered.reason = reason;
  result.rendered.planes = static_cast<int>(result.stack.slices.size());
  result.rendered.exposure = result.stack.exposure;
  if (!options.without_views)
    result.rendered.views = render_slices(result.stack, result.rig, options.rendering.filter, progress);
}

RenderedParticles stream(const std::filesystem::path& file, const RenderParticlesOptions& options,
                         const Progress& progress) {
  RenderedParticles result;
  CloudStatistics statistics;
  const SelectionCounts counts =
      for_each_chunk(file, options, "statistics", progress, [&](const Cloud& chunk) { statistics.add(chunk); });
  if (statistics.count == 0) refuse_nothing(file, counts);
  statistics.framed = framed_region(statistics, options.fit);
  const Staged staged = stage(options, statistics);
  SliceMaker maker(staged.scene, statistics, staged.rig, options.rendering);
  for_each_chunk(file, options, "slices", progress, [&](const Cloud& chunk) {
    maker.add(chunk);
    result.outside += count_outside(chunk, *statistics.framed);
  });
  result.stack = maker.finish(staged.viewing);
  result.rig = staged.rig;
  draw_slices(options, "layered: particles are streamed", result, progress);
  if (!statistics.has_density && !statistics.has_colour)
    result.warnings.emplace_back(
        "the file has no density, and streamed particles cannot estimate it: all are equally bright");
  result.particles = statistics.count;
  result.dropped = counts.dropped;
  result.mended = counts.mended;
  result.extreme = counts.extreme;
  return result;
}

}  // namespace

ReadyParticles ready_particles(Cloud cloud, const std::filesystem::path& file, const RenderParticlesOptions& options,
                               const Progress& progress) {
  ReadyParticles ready{.cloud = std::move(cloud)};
  ready.counts = select_particles(ready.cloud, options.selection);
  if (ready.cloud.size() == 0) refuse_nothing(file, ready.counts);
  check_positions(file, ready.cloud);
  if (ready.cloud.density.empty() && ready.cloud.colour.empty()) {
    estimate_density(ready.cloud, options.neighbours, progress);
    ready.density_estimated = true;
  }
  ready.statistics.add(ready.cloud);
  ready.statistics.framed = framed_region(ready.statistics, options.fit);
  return ready;
}

ReadyParticles read_particles(const std::filesystem::path& file, const RenderParticlesOptions& options,
                              const Progress& progress) {
  return ready_particles(read_cloud(file, choice_of(options), progress), file, options, progress);
}

// A point that is only looked at does not count: a window that looks elsewhere keeps the cloud it has, and shows the
// same picture.
CloudChoice choice_of(const RenderParticlesOptions& options) {
  CloudChoice choice = options.choice;
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

Scene scene_of(const CloudStatistics& statistics, const RenderParticlesOptions& options) {
  Framing framing = options.framing;
  if (options.look_at) {
    framing.look_at.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis)
      (*framing.look_at)[axis] = static_cast<float>((*options.look_at)[axis] - statistics.origin[axis]);
  }
  Scene scene;
  scene.camera = camera_around(statistics.centre(), statistics.radius(), options.width, options.height, framing);
  const auto depth_of = [&camera = scene.camera](const std::array<float, 3>& point) {
    float depth = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) depth += (point[axis] - camera.position[axis]) * camera.forward[axis];
    return depth;
  };
  const float distance = depth_of(framing.look_at.value_or(statistics.centre())), radius = statistics.radius();
  // A camera that looks at a point far from the particles may stand among them, or before them all.
  const float depth = std::max(depth_of(statistics.centre()), distance * 0.01f);
  scene.mapping = mapping_for(options.depth, options.width, std::max(depth - radius, depth * 0.01f), depth + radius);
  scene.splat_style = make_splat_style(options.appearance, statistics);
  scene.splat_style.size_depth = distance;
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
  const Cloud& cloud = particles.cloud;
  RenderedParticles result;
  result.particles = cloud.size();
  result.dropped = particles.counts.dropped;
  result.mended = particles.counts.mended;
  result.extreme = particles.counts.extreme;
  result.density_estimated = particles.density_estimated;
  result.outside = count_outside(cloud, *particles.statistics.framed);
  const Staged staged = stage(options, particles.statistics);
  result.rig = staged.rig;
  if (options.slices) {
    report(progress, "slices", 0);
    result.stack = make_slices(cloud, staged.scene, staged.rig, options.rendering, staged.viewing);
    draw_slices(options, "layered: slices are asked for", result, progress);
  } else {
    result.rendered = render(cloud, staged.scene, staged.rig, options.rendering, progress);
  }
  return result;
}

RenderedParticles render_particles(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                   const Progress& progress) {
  if (options.views < 1) throw Error(ErrorKind::wrong_usage, "there are 0 views, expected at least 1");
  make_splat_style(options.appearance, {});  // what makes no sense is said before the long work
  const CloudSource source = open_cloud(file, options.choice);
  if (options.selection.centre && !(source.box_size > 0))
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no periodic box, which a centre needs", file.string()));
  RenderedParticles result = options.stream ? stream(file, options, progress)
                                            : render_ready(read_particles(file, options, progress), options, progress);
  result.format = source.format;
  const ViewingGeometry viewing = viewing_of(options);
  const bool regions = !options.depth.regions.empty();
  float nearest = regions ? options.depth.regions.front().behind_mm : -options.depth.near_mm;
  float farthest = regions ? options.depth.regions.back().behind_mm : options.depth.far_mm;
  for (const PerceivedDepth::Region& region : options.depth.regions) {
    nearest = std::min(nearest, region.behind_mm);
    farthest = std::max(farthest, region.behind_mm);
  }
  for (std::string& warning : discomforts(viewing, -nearest, farthest)) result.warnings.push_back(std::move(warning));
  return result;
}

}  // namespace wheatstone
