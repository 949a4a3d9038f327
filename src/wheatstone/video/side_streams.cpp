#include "wheatstone/video/side_streams_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace wheatstone {

SideStreams::SideStreams(const FilmWriterOptions& options, AVFormatContext& output, std::vector<std::string>& notes)
    : start_s_(options.start_s),
      end_s_(options.end_s),
      source_(open_input(options.side_streams_from)),
      output_(output) {
  for (unsigned i = 0; i < source_->nb_streams; ++i) {
    AVStream& from = *source_->streams[i];
    from.discard = AVDISCARD_ALL;
    const AVMediaType type = from.codecpar->codec_type;
    if (type != AVMEDIA_TYPE_AUDIO && type != AVMEDIA_TYPE_SUBTITLE) continue;
    if (avformat_query_codec(output.oformat, from.codecpar->codec_id, FF_COMPLIANCE_EXPERIMENTAL) != 1) {
      notes.push_back(fmt::format(
          "{} stream {} ({}) of {} is left out: {} cannot hold it", type == AVMEDIA_TYPE_AUDIO ? "audio" : "subtitle",
          i, avcodec_get_name(from.codecpar->codec_id), options.side_streams_from.string(), output.oformat->name));
      continue;
    }
    AVStream* to = avformat_new_stream(&output, nullptr);
    if (to == nullptr || avcodec_parameters_copy(to->codecpar, from.codecpar) < 0) throw std::bad_alloc();
    to->codecpar->codec_tag = 0;  // a number of the source's container
    to->time_base = from.time_base;
    to->disposition = from.disposition;
    for (const char* key : {"language", "title"}) {
      if (const AVDictionaryEntry* tag = av_dict_get(from.metadata, key, nullptr, 0)) {
        av_dict_set(&to->metadata, key, tag->value, 0);
      }
    }
    from.discard = AVDISCARD_DEFAULT;
    targets_[static_cast<int>(i)] = {.stream = to};
  }
}

/// Reads on to the next packet that is to be copied.
bool SideStreams::fetch() {
  while (!fetched_ && !at_end_ && !targets_.empty()) {
    if (av_read_frame(source_.get(), packet_.get()) < 0) {
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
    if (!fetched_) av_packet_unref(packet_.get());
  }
  return fetched_;
}

int SideStreams::write_fetched() {
  Target& target = targets_.at(packet_->stream_index);
  const AVRational base = source_->streams[packet_->stream_index]->time_base;
  const auto shift = static_cast<std::int64_t>(std::llround(start_s_ / av_q2d(base)));
  if (packet_->pts != AV_NOPTS_VALUE) packet_->pts -= shift;
  if (packet_->dts != AV_NOPTS_VALUE) packet_->dts -= shift;
  av_packet_rescale_ts(packet_.get(), base, target.stream->time_base);
  // A source whose clock stumbles would end the writing.
  if (packet_->dts != AV_NOPTS_VALUE && target.stream->codecpar->codec_type == AVMEDIA_TYPE_AUDIO) {
    if (target.last_dts != AV_NOPTS_VALUE) packet_->dts = std::max(packet_->dts, target.last_dts + 1);
    if (packet_->pts != AV_NOPTS_VALUE) packet_->pts = std::max(packet_->pts, packet_->dts);
    target.last_dts = packet_->dts;
  }
  packet_->stream_index = target.stream->index;
  packet_->pos = -1;
  fetched_ = false;
  return av_interleaved_write_frame(&output_, packet_.get());
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
  return 0;
}

}  // namespace wheatstone
