#include "particle_scene.h"

#include "wheatstone/app/render_particles.h"

namespace wheatstone::viewer {

Scene particle_scene(const Particles& particles, const Framing& orbit, const Rig& rig) {
  RenderParticlesOptions options;
  options.width = rig.width;
  options.height = rig.height;
  options.framing = orbit;
  return scene_of(particles.statistics, options);
}

}  // namespace wheatstone::viewer
