#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/video/segment_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_bytes_of_times = std::size_t{64} << 20;

/// Numbers of pictures are written as milliseconds: Matroska keeps those exactly.
constexpr Rational numbering{1, 1000};

fs::path times_file(const fs::path& folder, std::int64_t number) {
  return folder / fmt::format("seg_{:06}.json", number);
}

/// Only the coding: what belongs to the whole film is said when the segments are joined.
FilmWriterOptions bare(FilmWriterOptions options) {
  options.side_streams_from.clear();
  options.start_s = 0;
  options.end_s.reset();
  options.layout = StereoLayout::mono;
  options.comment.clear();
  options.projection = "flat";
  return options;
}

}  // namespace

fs::path segment_film(const fs::path& folder, std::int64_t number) {
  return folder / fmt::format("seg_{:06}.mkv", number);
}

std::optional<SegmentTimes> segment_times(const fs::path& folder, std::int64_t number) {
  std::error_code ignored;
  const fs::path file = times_file(folder, number);
  if (!fs::exists(file, ignored) || !fs::exists(segment_film(folder, number), ignored)) return {};
  try {
    const json all = json::parse(read_whole_file(file, most_bytes_of_times));
    SegmentTimes times;
    times.time_base = {all.at("time_base").at(0).get<int>(), all.at("time_base").at(1).get<int>()};
    times.pts = all.at("pts").get<std::vector<std::int64_t>>();
    times.durations = all.at("durations").get<std::vector<std::int64_t>>();
    times.reordering = all.at("reordering").get<int>();
    const bool ascends = std::ranges::adjacent_find(times.pts, std::greater_equal<>()) == times.pts.end();
    if (times.pts.empty() || times.pts.size() != times.durations.size() || !ascends || times.reordering < 0 ||
        times.time_base.numerator < 1 || times.time_base.denominator < 1) {
      refuse_film(file, "its times make no sense; delete the folder to start again");
    }
    return times;
  } catch (const json::exception&) {
    refuse_film(file, "is damaged; delete the folder to start again");
  }
}

SegmentFile::SegmentFile(const fs::path& folder, std::int64_t number, const FilmWriterOptions& options,
                         const Frame& first)
    : folder_(folder),
      number_(number),
      encoder_(options, first.picture.width(), first.picture.height(), first.time_base),
      film_(segment_film(folder, number), bare(options), notes_) {
  times_.time_base = first.time_base;
  film_.begin(*parameters_of(encoder_.context()), numbering);
}

void SegmentFile::add(const Frame& frame) {
  times_.pts.push_back(frame.pts);
  times_.durations.push_back(frame.duration);
  encoder_.send(frame, [this](AVPacket& packet) { put(packet); });
}

void SegmentFile::put(AVPacket& packet) {
  const auto shown = std::ranges::lower_bound(times_.pts, packet.pts) - times_.pts.begin();
  times_.reordering = std::max(times_.reordering, static_cast<int>(packets_ - shown));
  packet.pts = shown;
  // A decoder's clock that surely runs ahead; the real one is made when segments are joined.
  packet.dts = packets_ - encoder_.context().has_b_frames - 64;
  packet.duration = 1;
  ++packets_;
  film_.add(packet);
}

void SegmentFile::finish() {
  encoder_.drain([this](AVPacket& packet) { put(packet); });
  film_.finish();
  const json all = {{"time_base", {times_.time_base.numerator, times_.time_base.denominator}},
                    {"pts", times_.pts},
                    {"durations", times_.durations},
                    {"reordering", times_.reordering}};
  write_whole_file(times_file(folder_, number_), all.dump() + "\n");
}

std::int64_t read_segment(const fs::path& folder, std::int64_t number,
                          const std::function<void(const AVCodecParameters&, AVPacket&, std::size_t)>& sink) {
  const fs::path file = segment_film(folder, number);
  const OwnedInput input = open_input(file);
  const int index = video_stream_of(*input);
  if (index < 0) refuse_film(file, "has no pictures; delete the folder to start again");
  const AVStream& stream = *input->streams[index];
  const OwnedPacket packet = new_packet();
  std::int64_t count = 0;
  while (libav().av_read_frame(input.get(), packet.get()) >= 0) {
    if (packet->stream_index == index) {
      const std::int64_t shown = libav().av_rescale_q(packet->pts, stream.time_base, as_av(numbering));
      if (packet->pts == AV_NOPTS_VALUE || shown < 0) refuse_film(file, "is damaged; delete the folder to start again");
      sink(*stream.codecpar, *packet, static_cast<std::size_t>(shown));
      ++count;
    }
    libav().av_packet_unref(packet.get());
  }
  return count;
}

}  // namespace wheatstone
