#pragma once

#include "viewer.h"
#include "wheatstone/depth/rig.h"

namespace wheatstone::viewer {

/// The particles that are open; none where something else is.
const Particles* open_particles(const Viewer& viewer);

/// The views that a viewer's two eyes are shown.
Rig eyes_of(const Viewer& viewer);

/// Moves what is seen of particles by so many pixels of an eye's picture. Does nothing, and returns false, where
/// something else is open.
bool pan_particles(Viewer& viewer, double x_px, double y_px);

/// Magnifies particles so many times more; what lies so far from the middle of an eye's picture stays there.
bool magnify_particles(Viewer& viewer, double factor, double x_px = 0, double y_px = 0);

/// Shows particles as when they were opened.
bool fit_particles(Viewer& viewer);

}  // namespace wheatstone::viewer
