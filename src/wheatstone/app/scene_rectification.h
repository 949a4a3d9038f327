#pragma once

#include <optional>
#include <string>

#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// How the frames of one scene of a film are rectified: alike, so that nothing moves that did not.
struct SceneRectification {
  bool measured = false;             ///< a frame of the scene showed whether its rows fit
  std::optional<Rectification> how;  ///< none: the frames are taken as they are
  std::optional<ColourTransfer> colour;
};

struct MeasuredScene {
  SceneRectification rectification;
  std::string note;  ///< one sentence where the frames are rectified, or should be and are not; empty: nothing to tell
};

/// Measures a frame of a scene. If the frame says nothing (black, too little texture), `measured` is false. The frames'
/// size is kept. If `progress` throws, measuring ends.
MeasuredScene measure_scene(const StereoPair& frame, RectifyPolicy policy, const Progress& progress = {});

/// A frame of that scene.
StereoPair rectified(const StereoPair& frame, const SceneRectification& scene);

}  // namespace wheatstone
