#include "wheatstone/video/decoded_film_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <utility>

extern "C" {
#include <libavutil/display.h>
}

#include "wheatstone/files/module.h"
#include "wheatstone/video/kept_metadata_internal.h"
#include "wheatstone/video/stereo_metadata_internal.h"

namespace wheatstone {
namespace {

// A decoder asked for more would take gigabytes on the word of a header.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

std::string tag_of(const AVDictionary* tags, const char* key) {
  const AVDictionaryEntry* entry = libav().av_dict_get(tags, key, nullptr, 0);
  return entry == nullptr ? "" : entry->value;
}

std::vector<SideStream> side_streams_of(const AVFormatContext& input) {
  std::vector<SideStream> found;
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    const AVStream& stream = *input.streams[i];
    const AVMediaType type = stream.codecpar->codec_type;
    if (type != AVMEDIA_TYPE_AUDIO && type != AVMEDIA_TYPE_SUBTITLE) continue;
    found.push_back({.index = static_cast<int>(i),
                     .kind = type == AVMEDIA_TYPE_AUDIO ? "audio" : "subtitles",
                     .codec = libav().avcodec_get_name(stream.codecpar->codec_id),
                     .language = tag_of(stream.metadata, "language"),
                     .channels = stream.codecpar->ch_layout.nb_channels,
                     .sample_rate = stream.codecpar->sample_rate});
  }
  return found;
}

/// "mov,mp4,m4a,…" is one format to libav; to people the file's ending tells which.
std::string container_of(const std::string& names, const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  if (("," + names + ",").find("," + ending + ",") != std::string::npos && !ending.empty()) return ending;
  return names.substr(0, names.find(','));
}

bool is_damaged(const AVFrame& frame) {
  return frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
}

}  // namespace

DecodedFilm::DecodedFilm(std::filesystem::path path, int threads) : path_(std::move(path)), threads_(threads) {
  open();
  look_ahead();
  if (!time_ahead_) refuse_film(path_, "no frame of it can be decoded");
  gather_facts();
}

void DecodedFilm::open() {
  input_ = open_input(path_);
  const int index = video_stream_of(*input_);
  if (index < 0) refuse_film(path_, "has no moving pictures, expected a film");
  stream_ = input_->streams[index];
  for (unsigned i = 0; i < input_->nb_streams; ++i) {
    if (static_cast<int>(i) != index) input_->streams[i]->discard = AVDISCARD_ALL;
  }
  open_decoder(*stream_);
}

void DecodedFilm::open_decoder(const AVStream& stream) {
  const char* name = libav().avcodec_get_name(stream.codecpar->codec_id);
  const AVCodec* codec = libav().avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr) {
    const std::string known = stream.codecpar->codec_id == AV_CODEC_ID_NONE ? "unknown" : name;
    refuse_film(path_, fmt::format("its video codec is {}, which cannot be decoded", known));
  }
  decoder_.reset(libav().avcodec_alloc_context3(codec));
  if (!decoder_) throw std::bad_alloc();
  int error = libav().avcodec_parameters_to_context(decoder_.get(), stream.codecpar);
  decoder_->pkt_timebase = stream.time_base;
  decoder_->thread_count = threads_;
  decoder_->max_pixels = most_pixels;
  if (error >= 0) error = libav().avcodec_open2(decoder_.get(), codec, nullptr);
  if (error < 0) refuse_film(path_, fmt::format("its {} pictures cannot be decoded: {}", name, libav_reason(error)));
}

void DecodedFilm::gather_facts() {
  const AVCodecParameters& coded = *stream_->codecpar;
  const char* format = libav().av_get_pix_fmt_name(static_cast<AVPixelFormat>(ahead_->format));
  stored_width_ = ahead_->width;
  stored_height_ = ahead_->height;
  if (stream_->side_data != nullptr) {
    std::size_t size = 0;
    const std::uint8_t* matrix = libav().av_stream_get_side_data(stream_, AV_PKT_DATA_DISPLAYMATRIX, &size);
    if (matrix != nullptr && size >= 9 * sizeof(std::int32_t)) {
      orientation_ = orientation_of(reinterpret_cast<const std::int32_t*>(matrix));
    }
  }

  facts_.container = container_of(input_->iformat->name, path_);
  facts_.codec = libav().avcodec_get_name(coded.codec_id);
  facts_.pixel_format = format == nullptr ? "" : format;
  facts_.width = orientation_.swaps_sides() ? stored_height_ : stored_width_;
  facts_.height = orientation_.swaps_sides() ? stored_width_ : stored_height_;
  facts_.rotation_degrees = orientation_.degrees();
  const AVRational aspect = libav().av_guess_sample_aspect_ratio(input_.get(), stream_, ahead_.get());
  facts_.pixel_aspect = aspect.num > 0 && aspect.den > 0 ? from_av(aspect) : Rational{1, 1};
  facts_.frame_rate = from_av(stream_->avg_frame_rate.num > 0 ? stream_->avg_frame_rate : stream_->r_frame_rate);
  facts_.time_base = from_av(stream_->time_base);
  facts_.duration_s = stated_end_s();
  if (stream_->nb_frames > 0) facts_.frame_count = stream_->nb_frames;
  facts_.colour = colour_tags_of(ahead_->colorspace, ahead_->color_range, ahead_->color_primaries, ahead_->color_trc);
  facts_.projection = projection_of(*stream_);
  facts_.comment = tag_of(input_->metadata, "comment");
  facts_.side_streams = side_streams_of(*input_);
  gather_layout();
}

void DecodedFilm::gather_layout() {
  const AVRational aspect = as_av(facts_.pixel_aspect);
  std::size_t size = 0;
  const std::uint8_t* of_stream = libav().av_stream_get_side_data(stream_, AV_PKT_DATA_STEREO3D, &size);
  if (of_stream != nullptr && size >= sizeof(AVStereo3D)) {
    facts_.layout = layout_of(*reinterpret_cast<const AVStereo3D*>(of_stream), stored_width_, stored_height_, aspect);
    facts_.layout_how = facts_.container == "mp4" || facts_.container == "mov" ? "the container's stereo box"
                                                                               : "the container's stereo mode";
    return;
  }
  const AVFrameSideData* of_frame = libav().av_frame_get_side_data(ahead_.get(), AV_FRAME_DATA_STEREO3D);
  if (of_frame == nullptr) return;
  facts_.layout =
      layout_of(*reinterpret_cast<const AVStereo3D*>(of_frame->data), stored_width_, stored_height_, aspect);
  facts_.layout_how = "the pictures' frame packing message";
}

double DecodedFilm::stated_end_s() {
  stream_states_end_ = true;
  if (stream_->duration != AV_NOPTS_VALUE && stream_->duration > 0) {
    return static_cast<double>(stream_->duration) * av_q2d(stream_->time_base);
  }
  // Matroska writers leave each stream's own length in a tag.
  int hours = 0, minutes = 0;
  double seconds = 0;
  const std::string tag = tag_of(stream_->metadata, "DURATION");
  if (std::sscanf(tag.c_str(), "%d:%d:%lf", &hours, &minutes, &seconds) == 3)
    return hours * 3600 + minutes * 60 + seconds;
  stream_states_end_ = input_->nb_streams == 1;
  return input_->duration == AV_NOPTS_VALUE ? 0 : static_cast<double>(input_->duration) / AV_TIME_BASE;
}

void DecodedFilm::seek_before(double seconds) {
  // Of a frame's fields, those of the frame before tell, too.
  const double rate = facts_.frame_rate.value();
  if (facts_.interlaced && rate > 0) seconds -= 2 / rate;
  const auto target = static_cast<std::int64_t>(std::floor(seconds / av_q2d(stream_->time_base)));
  if (time_ahead_ && time_ahead_->pts >= target) return;
  searched_ = true;
  if (libav().av_seek_frame(input_.get(), stream_->index, target, AVSEEK_FLAG_BACKWARD) >= 0) {
    libav().avcodec_flush_buffers(decoder_.get());
    decode_afresh();
    if (time_ahead_ && time_ahead_->pts <= target) return;
  }
  // Searching failed or went too far: from the beginning, then.
  open();
  decode_afresh();
}

void DecodedFilm::decode_afresh() {
  fed_all_ = at_end_ = false;
  deinterlacer_.reset();
  read_error_ = 0;
  time_ahead_.reset();
  look_ahead();
}

bool DecodedFilm::step() {
  if (!time_ahead_) {
    at_end_ = true;
    return false;
  }
  std::swap(frame_, ahead_);
  time_ = *time_ahead_;
  check_size();
  look_ahead();
  if (time_ahead_) time_.duration = time_ahead_->pts - time_.pts;
  return true;
}

/// The next packet of the pictures, which is to be given back. False where none follows.
bool DecodedFilm::read_packet() {
  while (true) {
    const int error = libav().av_read_frame(input_.get(), packet_.get());
    if (error < 0) {
      if (error != AVERROR_EOF) read_error_ = error;
      return false;
    }
    if (packet_->stream_index == stream_->index) break;
    libav().av_packet_unref(packet_.get());
  }
  ++packets_;
  // Packets come in the order of decoding.
  const std::int64_t pts = packet_->pts != AV_NOPTS_VALUE ? packet_->pts : packet_->dts;
  if (pts != AV_NOPTS_VALUE && pts >= latest_.pts) latest_ = {pts, usual_duration(packet_->duration)};
  return true;
}

/// Gives the decoder the next packet, or the word that none follows.
void DecodedFilm::feed() {
  if (!read_packet()) {
    fed_all_ = true;
    libav().avcodec_send_packet(decoder_.get(), nullptr);
    return;
  }
  const bool is_corrupt = (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0;
  const bool is_refused = libav().avcodec_send_packet(decoder_.get(), packet_.get()) == AVERROR_INVALIDDATA;
  if (is_corrupt || is_refused) ++damaged_;
  libav().av_packet_unref(packet_.get());
}

void DecodedFilm::pass_over_rest() {
  while (!fed_all_ && read_packet()) libav().av_packet_unref(packet_.get());
  time_ = latest_;
  time_ahead_.reset();
  at_end_ = true;
}

void DecodedFilm::open_deinterlacer() {
  auto* const open = reinterpret_cast<OpenDeinterlacer*>(
      function_of_module(avfilter_module_name, open_deinterlacer_name, avfilter_module_bytes));
  deinterlacer_.reset(open(*ahead_, stream_->time_base, threads_));
  if (!deinterlacer_) refuse_film(path_, "its frames are interlaced, and libavfilter cannot deinterlace them");
  facts_.interlaced = true;
}

/// The next frame, from the decoder or from what makes whole frames of its fields. Returns libav's error, or 0.
int DecodedFilm::receive() {
  while (true) {
    if (deinterlacer_) {
      const int error = deinterlacer_->receive(*ahead_);
      if (error != AVERROR(EAGAIN)) return error;
    }
    const int error = libav().avcodec_receive_frame(decoder_.get(), ahead_.get());
    if (error == 0 && !deinterlacer_ && (facts_.interlaced || ahead_->interlaced_frame != 0)) open_deinterlacer();
    if (!deinterlacer_ || (error < 0 && error != AVERROR_EOF)) return error;
    const int sent = deinterlacer_->send(error == 0 ? ahead_.get() : nullptr);
    if (sent < 0) return sent;
  }
}

void DecodedFilm::look_ahead() {
  while (true) {
    const int error = receive();
    if (error == 0) {
      if (is_damaged(*ahead_)) ++damaged_;
      time_ahead_ = time_of(*ahead_);
      return;
    }
    if (error == AVERROR(EAGAIN) && !fed_all_) {
      feed();
    } else if (error == AVERROR_INVALIDDATA) {
      ++damaged_;
    } else {
      time_ahead_.reset();
      return;
    }
  }
}

/// What is said of a frame's duration, or else that of the average frame.
std::int64_t DecodedFilm::usual_duration(std::int64_t said) const {
  const AVRational rate = stream_->avg_frame_rate;
  if (said > 0 || rate.num <= 0) return std::max<std::int64_t>(0, said);
  return libav().av_rescale_q(1, av_inv_q(rate), stream_->time_base);
}

FrameTime DecodedFilm::time_of(const AVFrame& frame) const {
  FrameTime time{frame.best_effort_timestamp, usual_duration(frame.pkt_duration)};
  const FrameTime* before = time_ahead_ ? &*time_ahead_ : nullptr;
  if (time.pts == AV_NOPTS_VALUE) time.pts = before ? before->pts + std::max<std::int64_t>(1, before->duration) : 0;
  // Two frames at one moment, or time that runs backwards, could not be written again.
  if (before) time.pts = std::max(time.pts, before->pts + 1);
  return time;
}

void DecodedFilm::check_size() const {
  if (frame_->width == stored_width_ && frame_->height == stored_height_) return;
  refuse_film(path_, fmt::format("its pictures change from {}x{} to {}x{} pixels after {:.2f} s, expected one size",
                                 stored_width_, stored_height_, frame_->width, frame_->height,
                                 static_cast<double>(time_.pts) * av_q2d(stream_->time_base)));
}

void DecodedFilm::convert(Image<Rgb8>& picture) {
  rgb_from_frame_.convert(*frame_, picture);
  if (!orientation_.is_upright()) picture = turned(picture, orientation_);
}

void DecodedFilm::convert_deep(Image<Rgb16>& picture) {
  if (!is_deep(static_cast<AVPixelFormat>(frame_->format))) return;
  deep_from_frame_.convert(*frame_, picture);
  if (!orientation_.is_upright()) picture = turned(picture, orientation_);
}

std::optional<std::string> DecodedFilm::loss() const {
  if (!at_end_) return {};
  std::string lost;
  const auto add = [&lost](const std::string& what) { lost += (lost.empty() ? "" : "; ") + what; };
  const double end = static_cast<double>(time_.pts + time_.duration) * av_q2d(stream_->time_base);
  const double start =
      stream_->start_time == AV_NOPTS_VALUE ? 0 : static_cast<double>(stream_->start_time) * av_q2d(stream_->time_base);
  const double stated = facts_.duration_s + (facts_.container == "matroska" || facts_.container == "mkv" ? 0 : start);
  const bool whole_count = !searched_ && facts_.frame_count.has_value();
  const double tolerance = std::max(0.1, 3 * static_cast<double>(time_.duration) * av_q2d(stream_->time_base));
  if (whole_count && packets_ < *facts_.frame_count) {
    add(fmt::format("breaks off after {} of {} frames", packets_, *facts_.frame_count));
  } else if (!whole_count && stream_states_end_ && facts_.duration_s > 0 && end < stated - tolerance) {
    add(fmt::format("breaks off after {:.2f} of {:.2f} s", end, facts_.duration_s));
  } else if (read_error_ != 0) {
    add(fmt::format("breaks off after {:.2f} s: {}", end, libav_reason(read_error_)));
  }
  if (damaged_ > 0) add(fmt::format("{} frames are damaged or missing", damaged_));
  if (lost.empty()) return {};
  return fmt::format("{}: {}", path_.string(), lost);
}

}  // namespace wheatstone
