#pragma once

// Audio and subtitles of a source, copied packet by packet into another file.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {

/// A stream of an output that takes packets of another file's stream.
class CopiedStream {
 public:
  CopiedStream(AVFormatContext& output, const AVStream& from);

  /// Makes a packet of the source one of this stream; `start_s` of the source becomes 0.
  void fit(AVPacket& packet, AVRational time_base, double start_s);

 private:
  AVStream* stream_;
  std::int64_t last_dts_ = AV_NOPTS_VALUE;
};

/// Tries on a file in memory whether a kind of container takes streams of a source: some are declared without what the
/// container must say of them, which only shows when the head or the first packets are written.
class SideStreamTrial {
 public:
  SideStreamTrial(const std::filesystem::path& source, const AVOutputFormat& format);

  /// 0, or libav's error number. Once for a stream.
  int error_of(const AVStream& from);

 private:
  std::map<int, std::vector<OwnedPacket>> packets_;  ///< the first ones, by the source's stream
  const AVOutputFormat& format_;
};

class SideStreams {
 public:
  /// Adds to `output` a stream for each of the source's that it takes, and to `notes` a line for each other.
  SideStreams(const FilmWriterOptions& options, AVFormatContext& output, std::vector<std::string>& notes);

  /// Writes the packets that come before this moment of the film; without one, all that are left. A packet that the
  /// container cannot take is left out, and the last call notes how many were. Returns libav's error number of the
  /// first write that fails otherwise, or 0.
  int copy_until(std::optional<double> seconds);

 private:
  bool fetch();
  int write_fetched();
  void note_dropped();

  double start_s_;
  std::optional<double> end_s_;
  std::string source_name_;
  OwnedInput source_;
  AVFormatContext& output_;
  std::vector<std::string>& notes_;
  std::map<int, CopiedStream> targets_;  ///< by the source's stream
  OwnedPacket packet_ = new_packet();
  bool fetched_ = false;  ///< a packet lies ready
  bool at_end_ = false;
  std::int64_t dropped_ = 0;
};

}  // namespace wheatstone
