#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

/// The particles of a snapshot, with their motion, in the order of their IDs.
struct TimedCloud {
  Cloud cloud;
  double time = 0;  ///< CloudSource::time
};

/// Reads a snapshot whose particles are to be followed to another one. Throws as read_cloud, and Error{bad_input} where
/// the format has no IDs, the header no time, or an ID is there twice.
TimedCloud read_timed_cloud(const std::filesystem::path& file, const CloudChoice& choice,
                            const Progress& progress = {});

/// Which particles of two snapshots are the same, by their numbers in the clouds.
struct MatchedParticles {
  std::vector<std::array<std::uint32_t, 2>> both;
  std::vector<std::uint32_t> only_earlier, only_later;
};

/// By their IDs, in whose order both clouds are.
MatchedParticles match_particles(const Cloud& earlier, const Cloud& later);

/// The particles at a time between two snapshots. Those in both move along the cubic that has their positions and
/// velocities at either end, or straight where a file has no velocities, the shorter way through a periodic box; their
/// density, temperature, smoothing length and mass change by equal factors in equal times. Those in one snapshot only
/// keep their velocity, and fade away or appear (Cloud::presence).
Cloud cloud_between(const TimedCloud& earlier, const TimedCloud& later, const MatchedParticles& matched, double time);

}  // namespace wheatstone
