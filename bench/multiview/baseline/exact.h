#pragma once

#include "wheatstone/depth/rig.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/particles/cloud.h"

/// The exact renderer as it was when the targets of bench/multiview were set, of particles in the thesis's look: what
/// speed-ups are measured against, so that they do not fall when the exact renderer itself gets faster.
namespace wheatstone::baseline {

/// One view, with automatic exposure where `exposure` is NaN: that takes a view of its own.
void render_exact(const Cloud& cloud, const Scene& scene, const Rig& rig, ViewPosition view, float exposure,
                  ImageView<Rgb8> picture);

}  // namespace wheatstone::baseline
