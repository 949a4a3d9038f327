#pragma once

// What happens in a scene of the synthetic film: what there is, and where everything is at a time.

#include <vector>

#include "wheatstone/synthetic/synthetic_film.h"
#include "wheatstone/synthetic/synthetic_still_view_internal.h"

namespace wheatstone::still {

/// A thing that moves as a whole: its objects, and the point about which they turn.
struct Mover {
  std::vector<int> objects;
  Vec3 pivot;
  float phase = 0;  ///< where in its motion it begins
};

/// A scene of the film at rest, lit; things that may move cast no shadow, which would stay behind.
struct Shot {
  Scene scene;
  std::vector<Mover> movers;
};

Shot make_shot(const SyntheticFilmOptions& options, std::uint64_t seed);

/// The shot with everything where it is at a time, in frames from the shot's first.
Scene scene_at(const Shot& shot, const SyntheticFilmOptions& options, float time);

Cameras cameras_at(const SyntheticFilmOptions& options, float time);

/// The times of a frame's exposure, in frames from its middle, evenly: one where nothing blurs. Their number is odd, so
/// that one of them is the middle.
std::vector<float> exposure_of(const SyntheticFilmOptions& options);

}  // namespace wheatstone::still
