#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "wheatstone/app/particle_frames.h"
#include "wheatstone/app/render_film.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/multiview/render_model.h"

namespace wheatstone {

/// A model that was read, and the sphere around it, in whose middle the scene's origin is.
struct ReadyModel {
  ReadModel read;
  std::array<double, 3> origin{};
  float radius = 0;
};

/// Reads a model. Throws Error as read_model, and {bad_input} for one whose triangles all lie in one point.
ReadyModel ready_model(const std::filesystem::path& file, const RenderParticlesOptions& options = {},
                       const Progress& progress = {});

/// The scene as the central camera has it. Throws Error{wrong_usage} for the options.
ModelScene scene_of(const ReadyModel& model, const RenderParticlesOptions& options);

/// The views of a model that is ready; where values are asked for, their depth in scene units. Of the options, those of
/// particles have no effect. Of what is told, the comfort of the depth is left to the caller.
RenderedParticles render_ready(const ReadyModel& model, const RenderParticlesOptions& options,
                               const Progress& progress = {});

/// A file of a model to the views of a rig. Throws Error: bad_input for the file, wrong_usage for the options.
RenderedParticles render_model_file(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                    const Progress& progress = {});

/// The frames of a film in which a camera moves around a model, and how many there are. Throws as render_model_file.
struct ModelFrames {
  FrameSource source;
  int count = 1;
};
ModelFrames frames_of_model(const std::filesystem::path& file, ParticleFramesOptions options,
                            const Progress& progress = {});

}  // namespace wheatstone
