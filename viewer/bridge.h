#pragma once

namespace wheatstone::viewer {

class Viewer;

/// Has the Looking Glass that is attached taken as the screen: another program of ours asks Looking Glass Bridge for
/// its calibration, beside all else. What fails is told.
void use_screen_of_bridge(Viewer& viewer);

}  // namespace wheatstone::viewer
