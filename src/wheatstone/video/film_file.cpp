#include "wheatstone/video/film_file_internal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/kept_metadata_internal.h"
#include "wheatstone/video/stereo_metadata_internal.h"
#include "wheatstone/video/video_codings_internal.h"

namespace wheatstone {
namespace {

enum class Container { mp4, quicktime, matroska, webm, other };

Container container_of(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".mp4" || ending == ".m4v") return Container::mp4;
  if (ending == ".mov") return Container::quicktime;
  if (ending == ".mkv" || ending == ".mk3d") return Container::matroska;
  return ending == ".webm" ? Container::webm : Container::other;
}

const char* format_of(Container container) {
  switch (container) {
    case Container::mp4:
      return "mp4";
    case Container::quicktime:
      return "mov";
    case Container::webm:
      return "webm";
    default:
      return "matroska";
  }
}

bool is_matroska(Container container) { return container == Container::matroska || container == Container::webm; }

/// The stereo modes that WebM has.
bool webm_can_say(std::string_view matroska_mode) {
  return matroska_mode == "left_right" || matroska_mode == "right_left" || matroska_mode == "top_bottom" ||
         matroska_mode == "bottom_top";
}

/// Of a codec that others know by the container's tag: by which.
std::uint32_t tag_of(const AVCodecParameters& coded, Container container) {
  // Each of its profiles has its own.
  if (coded.codec_id == AV_CODEC_ID_PRORES) return coded.codec_tag;
  if (coded.codec_id == AV_CODEC_ID_DNXHD && container == Container::quicktime) return MKTAG('A', 'V', 'd', 'h');
  // The one by which Apple's players know HEVC.
  return coded.codec_id == AV_CODEC_ID_HEVC && !is_matroska(container) ? MKTAG('h', 'v', 'c', '1') : 0;
}

}  // namespace

void check_container(const std::filesystem::path& path, const FilmWriterOptions& options) {
  const Container container = container_of(path);
  if (container == Container::other) {
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("{}: films are written to .mp4, .m4v, .mov, .mkv, .webm, or numbered pictures like out_%04d.png",
                    path.string()));
  }
  const VideoCoding& coding = coding_of(options);
  if (std::ranges::find(coding.containers, ending_of(path)) == coding.containers.end())
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: cannot hold {}, expected {}", path.string(), coding.name,
                                                    fmt::join(coding.containers, ", ")));
  // Said before hours of work, at the end of which no name could be given.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot write: is a folder, expected the name of a film", path.string()));
}

std::vector<std::string> side_streams_left_out(const std::filesystem::path& path, const FilmWriterOptions& options) {
  std::vector<std::string> notes;
  const Container container = container_of(path);
  if (options.side_streams_from.empty() || container == Container::other) return notes;
  AVFormatContext* output = nullptr;
  if (libav().avformat_alloc_output_context2(&output, nullptr, format_of(container), nullptr) < 0)
    throw std::bad_alloc();
  const std::unique_ptr<AVFormatContext, decltype(LibavFunctions::avformat_free_context)> owned(
      output, libav().avformat_free_context);
  const SideStreams streams(options, *output, notes);
  return notes;
}

FilmFile::FilmFile(std::filesystem::path path, const FilmWriterOptions& options, std::vector<std::string>& notes)
    : path_(std::move(path)), options_(options), file_(path_), notes_(notes) {
  const int error =
      libav().avformat_alloc_output_context2(&output_, nullptr, format_of(container_of(path_)), file_.path().c_str());
  if (error < 0) fail_to_write_film(path_, error);
  // The same input gives the same bytes; and stereo boxes and some codecs in MP4 count as experiments.
  output_->flags |= AVFMT_FLAG_BITEXACT;
  output_->strict_std_compliance = FF_COMPLIANCE_EXPERIMENTAL;
}

FilmFile::~FilmFile() {
  side_streams_.reset();
  if (output_->pb != nullptr) libav().avio_closep(&output_->pb);
  libav().avformat_free_context(output_);
}

void FilmFile::check(int error) const {
  if (error < 0) fail_to_write_film(path_, error);
}

void FilmFile::begin(const AVCodecParameters& coded, Rational time_base, std::optional<Rational> rate) {
  stream_ = libav().avformat_new_stream(output_, nullptr);
  if (stream_ == nullptr || libav().avcodec_parameters_copy(stream_->codecpar, &coded) < 0) throw std::bad_alloc();
  const Container container = container_of(path_);
  stream_->codecpar->codec_tag = tag_of(coded, container);
  stream_->sample_aspect_ratio = coded.sample_aspect_ratio;
  time_base_ = as_av(time_base);
  stream_->time_base = time_base_;
  if (rate) stream_->avg_frame_rate = as_av(*rate);
  shift_ = std::llround(options_.start_s / av_q2d(time_base_));
  say_layout(*stream_);
  if (!options_.comment.empty()) libav().av_dict_set(&output_->metadata, "comment", options_.comment.c_str(), 0);
  OwnedInput source;
  if (!options_.side_streams_from.empty()) {
    side_streams_.emplace(options_, *output_, notes_);
    source = open_input(options_.side_streams_from);
    keep_chapters(*source, options_, *output_);
    keep_timecode(*source, options_, *stream_, notes_);
  }
  say_projection(source.get(), options_, *stream_);

  check(libav().avio_open(&output_->pb, ("file:" + file_.path().string()).c_str(), AVIO_FLAG_WRITE));
  AVDictionary* settings = nullptr;
  // The index in front: a film that arrives slowly, or not to its end, can be shown.
  if (!is_matroska(container)) libav().av_dict_set(&settings, "movflags", "+faststart", 0);
  const int error = libav().avformat_write_header(output_, &settings);
  libav().av_dict_free(&settings);
  check(error);
}

void FilmFile::say_layout(AVStream& stream) {
  const std::optional<AVStereo3D> stereo = stereo_of(options_.layout);
  if (!stereo) return;
  const Container container = container_of(path_);
  const LayoutTraits& traits = traits_of(options_.layout);
  if (is_matroska(container) && (container != Container::webm || webm_can_say(traits.matroska))) {
    libav().av_dict_set(&stream.metadata, "stereo_mode", std::string(traits.matroska).c_str(), 0);
    return;
  }
  const bool in_box = container == Container::mp4 && !traits.right_first &&
                      (stereo->type == AV_STEREO3D_SIDEBYSIDE || stereo->type == AV_STEREO3D_TOPBOTTOM);
  const bool in_pictures = options_.codec == "h264" && frame_packing_of(options_.layout).has_value();
  if (in_box) {
    std::uint8_t* data = libav().av_stream_new_side_data(&stream, AV_PKT_DATA_STEREO3D, sizeof(AVStereo3D));
    if (data == nullptr) throw std::bad_alloc();
    std::memcpy(data, &*stereo, sizeof(AVStereo3D));
  } else if (!in_pictures) {
    notes_.push_back(fmt::format("the layout {} cannot be stored in {} with {}; Matroska can store it", traits.name,
                                 format_of(container), options_.codec));
  }
}

void FilmFile::add(AVPacket& packet) {
  if (packet.pts != AV_NOPTS_VALUE) packet.pts -= shift_;
  if (packet.dts != AV_NOPTS_VALUE) packet.dts -= shift_;
  if (side_streams_) check(side_streams_->copy_until(static_cast<double>(packet.dts) * av_q2d(time_base_)));
  const std::int64_t pts = packet.pts;
  libav().av_packet_rescale_ts(&packet, time_base_, stream_->time_base);
  if (!rounds_times_ && libav().av_compare_ts(pts, time_base_, packet.pts, stream_->time_base) != 0) {
    notes_.emplace_back("Matroska keeps times to the nearest millisecond");
    rounds_times_ = true;
  }
  packet.stream_index = stream_->index;
  packet.pos = -1;
  check(libav().av_interleaved_write_frame(output_, &packet));
}

void FilmFile::finish() {
  if (side_streams_) check(side_streams_->copy_until({}));
  check(libav().av_write_trailer(output_));
  check(output_->pb->error);
  check(libav().avio_closep(&output_->pb));
  file_.commit();
}

}  // namespace wheatstone
