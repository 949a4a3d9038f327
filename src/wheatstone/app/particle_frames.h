#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/app/camera_path.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/app/snapshot_series.h"
#include "wheatstone/progress.h"

namespace wheatstone {

struct ParticleFramesOptions {
  RenderParticlesOptions particles;  ///< what is the same in all frames
  int count = 0;                     ///< of frames; 0: as many as there are snapshots, or files of slices
  float orbit_deg = 0;               ///< that the camera turns in all frames, evenly; the one after the last has it
  std::optional<CameraPath> path;
};

/// The values of the camera's path at one of a film's frames; none where there is no path.
CameraKey key_of_frame(const ParticleFramesOptions& film, int number);

/// The options of one of a film's frames, with its camera. `key` is the path's at that frame.
RenderParticlesOptions options_of_frame(const ParticleFramesOptions& film, int number, const CameraKey& key);

/// How far a frame is from the first, 0, to the last, 1.
double share_of_frame(const ParticleFramesOptions& film, int number);

/// The frames of a film of particles: of a snapshot around which the camera moves, or of a series of snapshots between
/// which the particles move. What the views are framed by, colours and exposure are the same in all frames, and chosen
/// for all snapshots.
class ParticleFrames {
 public:
  /// Reads every snapshot once. Throws as render_particles and find_series, Error{wrong_usage} where options do not
  /// fit.
  ParticleFrames(const std::string& input, const ParticleFramesOptions& options, const Progress& progress = {});

  int count() const { return options_.count; }
  /// Frame 0, 1, … Throws as render_particles.
  RenderedParticles frame(int number, const Progress& progress = {});

  /// The snapshots; none where there is one.
  const SnapshotSeries* series() const { return series_ ? &series_->series() : nullptr; }
  /// The particles of a series at a time, with what is held through the film. Throws as render_particles.
  ReadyParticles particles_at(double time, const Progress& progress = {});

 private:
  /// The camera at a frame, and what time it shows.
  struct Moment {
    CameraKey key;
    double time = 0;  ///< of a series
  };
  void survey(const std::string& input, const Progress& progress);
  void hold_brightness(const std::array<CloudStatistics, 2>& at_ends);
  Moment moment_of(int number) const;
  CloudStatistics held(CloudStatistics of_frame) const;

  ParticleFramesOptions options_;
  std::filesystem::path input_;
  std::optional<SeriesReader> series_;
  ReadyParticles still_;                   ///< where there is one snapshot
  CloudStatistics statistics_;             ///< of all snapshots
  ShownUnits units_;                       ///< of the first snapshot
  std::optional<double> redshift_, time_;  ///< of the first snapshot, as RenderedParticles has them
};

}  // namespace wheatstone
