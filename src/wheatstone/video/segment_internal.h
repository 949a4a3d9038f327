#pragma once

// One closed piece of a film: "seg_000123.mkv" with the coded pictures, numbered in the order in which they are shown,
// and "seg_000123.json" with their real times, which Matroska would round.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "wheatstone/video/film_file_internal.h"
#include "wheatstone/video/video_encoder_internal.h"

namespace wheatstone {

struct SegmentTimes {
  Rational time_base{1, 1};
  std::vector<std::int64_t> pts;  ///< ascending
  std::vector<std::int64_t> durations;
  int reordering = 0;  ///< by how many places a picture is decoded before it is shown, at most

  std::size_t size() const { return pts.size(); }
};

std::filesystem::path segment_film(const std::filesystem::path& folder, std::int64_t number);

/// The times of a segment; nothing where it is not whole. Throws Error{bad_input} where they make no sense.
std::optional<SegmentTimes> segment_times(const std::filesystem::path& folder, std::int64_t number);

/// Writes one segment; destroyed before `finish` it leaves nothing.
class SegmentFile {
 public:
  SegmentFile(const std::filesystem::path& folder, std::int64_t number, const FilmWriterOptions& options,
              const Frame& first);
  void add(const Frame& frame);
  void finish();

  std::size_t size() const { return times_.size(); }
  const AVCodecContext& encoder() const { return encoder_.context(); }

 private:
  void put(AVPacket& packet);

  std::filesystem::path folder_;
  std::int64_t number_;
  VideoEncoder encoder_;
  std::vector<std::string> notes_;  ///< of no interest: the joined film makes its own
  FilmFile film_;
  SegmentTimes times_;
  std::int64_t packets_ = 0;
};

/// Reads a segment's packets in the order of decoding; the sink learns which picture of the segment each is. Returns
/// how many there were. Throws Error{bad_input} where the file is damaged.
std::int64_t read_segment(const std::filesystem::path& folder, std::int64_t number,
                          const std::function<void(const AVCodecParameters&, AVPacket&, std::size_t)>& sink);

}  // namespace wheatstone
