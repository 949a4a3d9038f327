#include "wheatstone/video/video_encoder_internal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <new>
#include <span>

extern "C" {
#include <libavutil/cpu.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include "wheatstone/error.h"
#include "wheatstone/files/address_space.h"
#include "wheatstone/video/stereo_metadata_internal.h"

namespace wheatstone {
namespace {

struct Coding {
  const char* name;
  const char* encoder;
  bool has_quality;
  double usual_crf;
  std::vector<std::string> formats;  ///< the first is the usual one
};

const std::vector<Coding>& codings() {
  static const std::vector<Coding> all = {
      {"h264", "libx264", true, 16, {"yuv420p", "yuv422p", "yuv444p"}},
      {"hevc", "libx265", true, 18, {"yuv420p", "yuv422p", "yuv444p"}},
      {"ffv1", "ffv1", false, 0, {"bgr0", "yuv420p", "yuv422p", "yuv444p"}},
  };
  return all;
}

constexpr const char* presets[] = {"ultrafast", "superfast", "veryfast", "faster",   "fast",
                                   "medium",    "slow",      "slower",   "veryslow", "placebo"};

// Bytes depend on the number of threads: fixed, not the machine's. x265 3.5 that codes several frames at a time gives
// other bytes every time; its rows are coded by a pool of threads all the same.
/// What an encoder takes for frames of this size, and for the frames that it looks ahead: x264 writes on standard error
/// where it has too little.
std::size_t bytes_of_encoder(const std::string& codec, int width, int height) {
  constexpr std::size_t for_threads = std::size_t{160} << 20, bytes_a_pixel = 250;
  if (codec == "ffv1") return 0;
  return for_threads + bytes_a_pixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

int threads_of(const std::string& codec) { return codec == "hevc" ? 1 : 4; }

// What x264 core 164 computes with AVX-512 for its macroblock tree differs from run to run.
const char* x264_processor() { return (av_get_cpu_flags() & AV_CPU_FLAG_AVX512) != 0 ? "asm=avx2" : "asm=auto"; }

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::wrong_usage, what); }

const Coding& coding_of(const FilmWriterOptions& options) {
  const auto found = std::ranges::find_if(codings(), [&](const Coding& c) { return options.codec == c.name; });
  if (found == codings().end()) refuse(fmt::format("codec: {}, expected h264, hevc or ffv1", options.codec));
  return *found;
}

AVPixelFormat format_of(const FilmWriterOptions& options) {
  const Coding& coding = coding_of(options);
  const std::string& name = options.pixel_format.empty() ? coding.formats.front() : options.pixel_format;
  if (std::ranges::find(coding.formats, name) == coding.formats.end()) {
    refuse(fmt::format("pixel format: {}, expected {} for {}", name, fmt::join(coding.formats, ", "), coding.name));
  }
  return av_get_pix_fmt(name.c_str());
}

int rounded_up(int size, int log2_step) {
  const int step = 1 << log2_step;
  return (size + step - 1) / step * step;
}

/// The source's tags, with matrix and range made explicit: what was converted with them must be read with them.
void tag_colours(AVCodecContext& codec, const FilmWriterOptions& options, bool is_rgb) {
  const ColourTags& tags = options.colour;
  const auto known = [](int value, int otherwise) { return value < 0 ? otherwise : value; };
  codec.color_primaries =
      static_cast<AVColorPrimaries>(known(av_color_primaries_from_name(tags.primaries.c_str()), AVCOL_PRI_UNSPECIFIED));
  codec.color_trc = static_cast<AVColorTransferCharacteristic>(
      known(av_color_transfer_from_name(tags.transfer.c_str()), AVCOL_TRC_UNSPECIFIED));
  if (is_rgb) {
    codec.colorspace = AVCOL_SPC_RGB;
    codec.color_range = AVCOL_RANGE_JPEG;
    return;
  }
  auto matrix = static_cast<AVColorSpace>(known(av_color_space_from_name(tags.matrix.c_str()), AVCOL_SPC_UNSPECIFIED));
  if (matrix == AVCOL_SPC_RGB || matrix > AVCOL_SPC_BT2020_NCL) matrix = AVCOL_SPC_UNSPECIFIED;
  codec.colorspace = matrix_in_use(matrix, codec.width, codec.height);
  codec.color_range = tags.range == "pc" ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
  codec.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

void set_private_options(AVCodecContext& codec, const FilmWriterOptions& options, const Coding& coding) {
  if (coding.has_quality) {
    av_opt_set_double(codec.priv_data, "crf", options.crf.value_or(coding.usual_crf), 0);
    av_opt_set(codec.priv_data, "preset", options.preset.c_str(), 0);
  }
  if (options.codec == "h264") {
    std::string parameters = x264_processor();
    if (const auto packing = frame_packing_of(options.layout)) parameters += fmt::format(":frame-packing={}", *packing);
    // x264 takes six steps from the chroma of 4:4:4; who chooses that wants its chroma.
    if (codec.pix_fmt == AV_PIX_FMT_YUV444P) parameters += ":chroma-qp-offset=-6";
    av_opt_set(codec.priv_data, "x264-params", parameters.c_str(), 0);
  } else if (options.codec == "hevc") {
    // Its own threads; libav's setting is how many frames at a time.
    av_opt_set(codec.priv_data, "x265-params", "log-level=none:pools=4", 0);
  } else {
    codec.level = 3;
    codec.slices = 4;
    codec.gop_size = 1;
    av_opt_set_int(codec.priv_data, "slicecrc", 1, 0);
  }
}

}  // namespace

void check_encoding(const FilmWriterOptions& options) {
  const Coding& coding = coding_of(options);
  format_of(options);
  if (options.crf && !(*options.crf >= 0 && *options.crf <= 51)) {
    refuse(fmt::format("crf: {}, expected 0 (best) to 51", *options.crf));
  }
  if (options.crf && !coding.has_quality) refuse(fmt::format("crf: {} is lossless, expected none", coding.name));
  if (std::ranges::find_if(presets, [&](const char* name) { return options.preset == name; }) == std::end(presets)) {
    refuse(fmt::format("preset: {}, expected {}", options.preset, fmt::join(presets, ", ")));
  }
  if (avcodec_find_encoder_by_name(coding.encoder) == nullptr) {
    refuse(fmt::format("codec: {} is not in this installation's libavcodec ({})", coding.name, coding.encoder));
  }
}

void note_padding(ImageView<const Rgb8> picture, const AVCodecContext& codec, std::vector<std::string>& notes) {
  if (codec.width == picture.width() && codec.height == picture.height()) return;
  notes.push_back(fmt::format("{}x{} pixels become {}x{} by repeating the last column or row: chroma needs even sizes",
                              picture.width(), picture.height(), codec.width, codec.height));
}

VideoEncoder::VideoEncoder(const FilmWriterOptions& options, int width, int height, Rational time_base) {
  silence_libav();
  check_encoding(options);
  const Coding& coding = coding_of(options);
  const AVCodec* encoder = avcodec_find_encoder_by_name(coding.encoder);
  codec_.reset(avcodec_alloc_context3(encoder));
  if (!codec_) throw std::bad_alloc();
  AVCodecContext& codec = *codec_;
  codec.pix_fmt = format_of(options);
  const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(codec.pix_fmt);
  codec.width = rounded_up(width, format.log2_chroma_w);
  codec.height = rounded_up(height, format.log2_chroma_h);
  codec.time_base = as_av(time_base);
  codec.framerate = options.frame_rate.numerator > 0 ? as_av(options.frame_rate) : AVRational{25, 1};
  const Rational of_layout = pixel_aspect_of(options.layout);
  codec.sample_aspect_ratio = as_av(of_layout == Rational{1, 1} ? options.pixel_aspect : of_layout);
  codec.thread_count = threads_of(options.codec);
  // The header goes into the container; nothing in the packets tells when or where they were made.
  codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  tag_colours(codec, options, (format.flags & AV_PIX_FMT_FLAG_RGB) != 0);
  set_private_options(codec, options, coding);
  require_address_space(bytes_of_encoder(options.codec, width, height));
  const int error = avcodec_open2(&codec, encoder, nullptr);
  if (error < 0) {
    refuse(fmt::format("{} cannot encode {}x{} pixels as {}: {}", coding.name, codec.width, codec.height, format.name,
                       libav_reason(error)));
  }
  frame_from_rgb_.emplace(codec.width, codec.height, codec.pix_fmt, codec.colorspace, codec.color_range);
}

void VideoEncoder::send(ImageView<const Rgb8> picture, FrameTime time, const PacketSink& sink) {
  const OwnedFrame frame = frame_from_rgb_->convert(picture);
  frame->pts = time.pts;
  frame->pkt_duration = time.duration;
  frame->colorspace = codec_->colorspace;
  frame->color_range = codec_->color_range;
  frame->color_primaries = codec_->color_primaries;
  frame->color_trc = codec_->color_trc;
  frame->sample_aspect_ratio = codec_->sample_aspect_ratio;
  durations_[time.pts] = time.duration;
  const int error = avcodec_send_frame(codec_.get(), frame.get());
  if (error < 0) throw Error(ErrorKind::cannot_read_write, fmt::format("encoder: {}", libav_reason(error)));
  receive(sink);
}

void VideoEncoder::drain(const PacketSink& sink) {
  avcodec_send_frame(codec_.get(), nullptr);
  receive(sink);
}

void VideoEncoder::receive(const PacketSink& sink) {
  while (true) {
    const int error = avcodec_receive_packet(codec_.get(), packet_.get());
    if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return;
    if (error < 0) throw Error(ErrorKind::cannot_read_write, fmt::format("encoder: {}", libav_reason(error)));
    if (const auto duration = durations_.extract(packet_->pts)) packet_->duration = duration.mapped();
    sink(*packet_);
    av_packet_unref(packet_.get());
  }
}

}  // namespace wheatstone
