#pragma once

#include <optional>

#include "session.h"

namespace wheatstone::viewer {

constexpr double particle_frames_a_second = 25;

/// How long a series of particles plays, or a camera's path, in seconds; none where there is neither.
std::optional<double> particle_film_s(const Session& session);

/// The time of a series at the state's share of it, as ParticleFrames has it.
double series_time(const Session& session);

/// Looks from where the camera's path is at the state's share of it.
void look_along(Session& session);

/// A keyframe of how the state looks at particles. Throws Error{wrong_usage} where none are open.
CameraKey key_here(const Session& session);

/// The path with a key, in place of one that is less than half a frame away.
CameraPath with_key(const Session& session, const CameraKey& key);

/// The path without the key that is nearest to the state's share; it has one.
CameraPath without_nearest_key(const Session& session);

}  // namespace wheatstone::viewer
