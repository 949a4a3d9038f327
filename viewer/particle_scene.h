#pragma once

#include "content.h"
#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone::viewer {

/// What the views of a rig see of particles from a side, as `wheatstone render` has it without further options.
Scene particle_scene(const Particles& particles, const Framing& orbit, const Rig& rig);

}  // namespace wheatstone::viewer
