#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/particles/cloud_between.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// Snapshots of one simulation, their times ascending.
struct SnapshotSeries {
  std::vector<std::filesystem::path> files;
  std::vector<double> times;  ///< CloudSource::time
};

/// The snapshots of a pattern, "snap_%03d.hdf5". Nothing where the name is no pattern. Throws Error{bad_input} where
/// there are fewer than two, where a number between them is missing, or where a header tells no time or one that is not
/// after that of the snapshot before.
std::optional<SnapshotSeries> find_series(const std::string& pattern, const CloudChoice& choice = {});

/// Gives the particles of a series at any time. The two snapshots around the time asked for last are in memory.
class SeriesReader {
 public:
  SeriesReader(SnapshotSeries series, CloudChoice choice);

  const SnapshotSeries& series() const { return series_; }
  /// All clouds have the origin of the first one that is asked for. Throws as read_timed_cloud.
  Cloud at(double time, const Progress& progress = {});

 private:
  TimedCloud read(std::size_t number, const Progress& progress);
  void take(std::size_t number, const Progress& progress);

  SnapshotSeries series_;
  CloudChoice choice_;
  std::optional<std::size_t> taken_;  ///< number of the earlier snapshot
  TimedCloud earlier_, later_;
  MatchedParticles matched_;
};

}  // namespace wheatstone
