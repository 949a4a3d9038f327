#include "wheatstone/app/render_model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "wheatstone/app/render_limits.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

Rig rig_of(const RenderParticlesOptions& options) {
  return options.positions.empty() ? evenly_spaced(options.width, options.height, options.views, options.span)
                                   : Rig{options.width, options.height, options.positions};
}

}  // namespace

ReadyModel ready_model(const std::filesystem::path& file, const RenderParticlesOptions& options,
                       const Progress& progress) {
  check_render_options(options);
  ReadyModel model{.read = read_model(file, options.model.choice, progress)};
  model.origin = bounds_of(model.read.model).middle();
  double square = 0;
  for (const std::array<double, 3>& position : model.read.model.positions) {
    double of_one = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      of_one += (position[axis] - model.origin[axis]) * (position[axis] - model.origin[axis]);
    square = std::max(square, of_one);
  }
  model.radius = static_cast<float>(std::sqrt(square));
  if (!(model.radius > 0))
    throw Error(ErrorKind::bad_input, fmt::format("{}: all of it lies in one point", file.string()));
  return model;
}

ModelScene scene_of(const ReadyModel& model, const RenderParticlesOptions& options) {
  StagedCamera staged = staged_camera({0, 0, 0}, model.radius, model.origin, options);
  const ViewingGeometry& viewing = options.depth.viewing;
  return {.origin = model.origin,
          .camera = staged.camera,
          .mapping = std::move(staged.mapping),
          .look = {.background = options.model.background,
                   .samples = options.model.samples,
                   .shine = options.appearance.shine,
                   .turn = viewing.eye_separation_mm / viewing.viewing_distance_mm}};
}

RenderedParticles render_ready(const ReadyModel& model, const RenderParticlesOptions& options,
                               const Progress& progress) {
  check_render_options(options);
  RenderedParticles result;
  result.rig = rig_of(options);
  const ModelScene scene = scene_of(model, options);
  RenderedModel rendered = render_model(model.read.model, scene, result.rig,
                                        {.method = options.rendering.method, .geometry = options.values}, progress);
  result.rendered = {.views = std::move(rendered.views),
                     .method = rendered.method,
                     .reason = std::move(rendered.reason),
                     .device = "cpu"};
  for (Image<float>& depth : rendered.depth) result.values.push_back({.mean = std::move(depth)});
  result.units = {.length = "model units", .value = "model units", .name = "depth"};
  result.scene.camera = scene.camera;
  result.scene.mapping = scene.mapping;
  result.scene.splat_style.size_depth = staged_camera({0, 0, 0}, model.radius, model.origin, options).distance;
  result.format = model.read.format;
  result.triangles = model.read.model.triangles.size();
  result.degenerate = model.read.degenerate;
  result.warnings = model.read.warnings;
  if (rendered.drawn_triangles == 0)
    result.warnings.emplace_back("no triangle of the model is in the views; --look-at, --zoom and --fov move them");
  return result;
}

RenderedParticles render_model_file(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                    const Progress& progress) {
  RenderedParticles result = render_ready(ready_model(file, options, progress), options, progress);
  for (std::string& warning : discomforts_of(options)) result.warnings.push_back(std::move(warning));
  return result;
}

ModelFrames frames_of_model(const std::filesystem::path& file, ParticleFramesOptions options,
                            const Progress& progress) {
  options.count = std::max(options.count, 1);
  const auto model = std::make_shared<const ReadyModel>(ready_model(file, options.particles, progress));
  const int count = options.count;
  return {[model, options = std::move(options)](int number, const Progress& of_frame) {
            return render_ready(*model, options_of_frame(options, number, key_of_frame(options, number)), of_frame);
          },
          count};
}

}  // namespace wheatstone
