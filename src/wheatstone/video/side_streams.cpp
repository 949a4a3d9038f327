#include "wheatstone/video/side_streams_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <new>

namespace wheatstone {

namespace {

bool is_wanted(AVMediaType type, const FilmWriterOptions& options) {
  return (type == AVMEDIA_TYPE_AUDIO && options.copy_audio) ||
         (type == AVMEDIA_TYPE_SUBTITLE && options.copy_subtitles);
}

/// Why the container does not take a stream; empty where it does.
std::string refusal_of(const AVStream& stream, const AVOutputFormat& format, SideStreamTrial& trial) {
  if (libav().avformat_query_codec(&format, stream.codecpar->codec_id, FF_COMPLIANCE_EXPERIMENTAL) != 1)
    return fmt::format("{} cannot hold it", format.name);
  const int error = trial.error_of(stream);
  return error < 0 ? fmt::format("{} does not take it as it is ({})", format.name, libav_reason(error)) : "";
}

}  // namespace

CopiedStream::CopiedStream(AVFormatContext& output, const AVStream& from)
    : stream_(libav().avformat_new_stream(&output, nullptr)) {
  if (stream_ == nullptr || libav().avcodec_parameters_copy(stream_->codecpar, from.codecpar) < 0)
    throw std::bad_alloc();
  stream_->codecpar->codec_tag = 0;  // a number of the source's container
  stream_->time_base = from.time_base;
  stream_->disposition = from.disposition;
  for (const char* key : {"language", "title"}) {
    if (const AVDictionaryEntry* tag = libav().av_dict_get(from.metadata, key, nullptr, 0)) {
      libav().av_dict_set(&stream_->metadata, key, tag->value, 0);
    }
  }
}

void CopiedStream::fit(AVPacket& packet, AVRational time_base, double start_s) {
  const auto shift = static_cast<std::int64_t>(std::llround(start_s / av_q2d(time_base)));
  if (packet.pts != AV_NOPTS_VALUE) packet.pts -= shift;
  if (packet.dts != AV_NOPTS_VALUE) packet.dts -= shift;
  libav().av_packet_rescale_ts(&packet, time_base, stream_->time_base);
  // A source whose clock stumbles would end the writing.
  if (packet.dts != AV_NOPTS_VALUE && stream_->codecpar->codec_type == AVMEDIA_TYPE_AUDIO) {
    if (last_dts_ != AV_NOPTS_VALUE) packet.dts = std::max(packet.dts, last_dts_ + 1);
    if (packet.pts != AV_NOPTS_VALUE) packet.pts = std::max(packet.pts, packet.dts);
    last_dts_ = packet.dts;
  }
  packet.stream_index = stream_->index;
  packet.pos = -1;
}

SideStreams::SideStreams(const FilmWriterOptions& options, AVFormatContext& output, std::vector<std::string>& notes)
    : start_s_(options.start_s),
      end_s_(options.end_s),
      source_name_(options.side_streams_from.string()),
      source_(open_input(options.side_streams_from)),
      output_(output),
      notes_(notes) {
  std::optional<SideStreamTrial> trial;
  for (unsigned i = 0; i < source_->nb_streams; ++i) {
    AVStream& from = *source_->streams[i];
    from.discard = AVDISCARD_ALL;
    const AVMediaType type = from.codecpar->codec_type;
    if (!is_wanted(type, options)) continue;
    if (!trial) trial.emplace(options.side_streams_from, *output.oformat);
    const std::string refusal = refusal_of(from, *output.oformat, *trial);
    if (!refusal.empty()) {
      notes.push_back(fmt::format("{} stream {} ({}) of {} is left out: {}",
                                  type == AVMEDIA_TYPE_AUDIO ? "audio" : "subtitle", i,
                                  libav().avcodec_get_name(from.codecpar->codec_id), source_name_, refusal));
      continue;
    }
    from.discard = AVDISCARD_DEFAULT;
    targets_.emplace(static_cast<int>(i), CopiedStream(output, from));
  }
}

/// Reads on to the next packet that is to be copied.
bool SideStreams::fetch() {
  while (!fetched_ && !at_end_ && !targets_.empty()) {
    if (libav().av_read_frame(source_.get(), packet_.get()) < 0) {
      at_end_ = true;
      break;
    }
    const auto target = targets_.find(packet_->stream_index);
    if (target != targets_.end()) {
      const AVRational base = source_->streams[packet_->stream_index]->time_base;
      const std::int64_t shown = packet_->pts == AV_NOPTS_VALUE ? packet_->dts : packet_->pts;
      const double seconds = shown == AV_NOPTS_VALUE ? start_s_ : static_cast<double>(shown) * av_q2d(base);
      // Sound that begins a moment before zero (an encoder's run-up) belongs to a film that begins at zero.
      fetched_ = (start_s_ <= 0 || seconds >= start_s_) && (!end_s_ || seconds < *end_s_);
    }
    if (!fetched_) libav().av_packet_unref(packet_.get());
  }
  return fetched_;
}

int SideStreams::write_fetched() {
  targets_.at(packet_->stream_index).fit(*packet_, source_->streams[packet_->stream_index]->time_base, start_s_);
  fetched_ = false;
  const int error = libav().av_interleaved_write_frame(&output_, packet_.get());
  // Of a damaged packet, not of the disk.
  if (error != AVERROR(EINVAL) && error != AVERROR_INVALIDDATA) return error;
  ++dropped_;
  return 0;
}

void SideStreams::note_dropped() {
  if (dropped_ > 0)
    notes_.push_back(
        fmt::format("{} damaged packets of the audio and subtitles of {} are left out", dropped_, source_name_));
  dropped_ = 0;
}

int SideStreams::copy_until(std::optional<double> seconds) {
  while (fetch()) {
    const AVRational base = source_->streams[packet_->stream_index]->time_base;
    if (seconds && packet_->dts != AV_NOPTS_VALUE &&
        static_cast<double>(packet_->dts) * av_q2d(base) - start_s_ > *seconds) {
      return 0;
    }
    const int error = write_fetched();
    if (error < 0) return error;
  }
  if (!seconds) note_dropped();
  return 0;
}

}  // namespace wheatstone
