#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content.h"
#include "session.h"
#include "wheatstone/app/particle_frames.h"
#include "wheatstone/progress.h"

namespace wheatstone::viewer {

/// Reads the particles of a snapshot, or of a series of snapshots at any time between them, as `wheatstone render` has
/// them: of a series, two snapshots are in memory. Of one thread at a time.
class ParticleReader {
 public:
  /// A file, or the pattern of a series. Throws as find_series.
  explicit ParticleReader(std::filesystem::path input);

  /// The times of a series; empty of a single snapshot.
  const std::vector<double>& times() const { return times_; }
  /// Columns of the file, each of which can be a quantity.
  const std::vector<std::string>& fields() const { return fields_; }
  /// Throws as read_particles and ParticleFrames.
  std::shared_ptr<const Particles> read(const ParticleChoice& choice, double time, const Progress& progress = {});

 private:
  std::filesystem::path input_, first_;
  std::vector<double> times_;
  std::vector<std::string> fields_;
  bool time_is_scale_factor_ = false;
  std::optional<ParticleFrames> frames_;
  ParticleChoice frames_choice_;
};

/// The pattern of the numbered files to which this one belongs: "snap_007.hdf5" is of "snap_%03d.hdf5". Nothing where
/// its name has no number, or no other file of the pattern is there.
std::optional<std::filesystem::path> series_pattern_of(const std::filesystem::path& file);

/// The pattern of files that are all the snapshots of one series, but for holes; nothing where they are something else,
/// or where there are others of the pattern.
std::optional<std::filesystem::path> series_of_files(const std::vector<std::filesystem::path>& files);

constexpr double particle_frames_a_second = 25;

/// The times of the snapshots of a series; none of anything else.
std::span<const double> times_of(const Session& session);

/// How long a series of particles plays, or a camera's path around particles or a model, in seconds; none where there
/// is neither.
std::optional<double> particle_film_s(const Session& session);

/// The time of a series at the state's share of it, as ParticleFrames has it.
double series_time(const Session& session);

/// Looks from where the camera's path is at the state's share of it.
void look_along(Session& session);

/// A keyframe of how the state looks at particles or a model. Throws Error{wrong_usage} where neither is open.
CameraKey key_here(const Session& session);

/// The path with a key, in place of one that is less than half a frame away.
CameraPath with_key(const Session& session, const CameraKey& key);

/// The path without the key that is nearest to the state's share; it has one.
CameraPath without_nearest_key(const Session& session);

}  // namespace wheatstone::viewer
