#pragma once

// Audio and subtitles of a source, copied packet by packet into another file.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {

class SideStreams {
 public:
  /// Adds to `output` a stream for each of the source's that it can hold, and to `notes` a line for each other.
  SideStreams(const FilmWriterOptions& options, AVFormatContext& output, std::vector<std::string>& notes);

  /// Writes the packets that come before this moment of the film; without one, all that are left. Returns libav's error
  /// number of the first write that fails, or 0.
  int copy_until(std::optional<double> seconds);

 private:
  struct Target {
    AVStream* stream = nullptr;
    std::int64_t last_dts = AV_NOPTS_VALUE;
  };
  bool fetch();
  int write_fetched();

  double start_s_;
  std::optional<double> end_s_;
  OwnedInput source_;
  AVFormatContext& output_;
  std::map<int, Target> targets_;  ///< by the source's stream
  OwnedPacket packet_ = new_packet();
  bool fetched_ = false;  ///< a packet lies ready
  bool at_end_ = false;
};

}  // namespace wheatstone
