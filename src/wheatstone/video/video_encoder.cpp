#include "wheatstone/video/video_encoder_internal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/files/module.h"
#include "wheatstone/video/kept_metadata_internal.h"
#include "wheatstone/video/stereo_metadata_internal.h"
#include "wheatstone/video/video_codings_internal.h"

namespace wheatstone {
namespace {

/// What an encoder takes for frames of this size, and for the frames that it looks ahead: x264 writes on standard error
/// where it has too little.
std::size_t bytes_of_encoder(const std::string& codec, int width, int height) {
  constexpr std::size_t for_threads = std::size_t{160} << 20, bytes_a_pixel = 250;
  if (codec == "ffv1") return 0;
  return for_threads + bytes_a_pixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// What x264 core 164 computes with AVX-512 for its macroblock tree differs from run to run.
const char* x264_processor() {
  return (libav().av_get_cpu_flags() & AV_CPU_FLAG_AVX512) != 0 ? "asm=avx2" : "asm=auto";
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::wrong_usage, what); }

int rounded_up(int size, int log2_step) {
  const int step = 1 << log2_step;
  return (size + step - 1) / step * step;
}

/// The source's tags, with matrix and range made explicit: what was converted with them must be read with them.
void tag_colours(AVCodecContext& codec, const FilmWriterOptions& options, bool is_rgb) {
  const ColourTags& tags = options.colour;
  const auto known = [](int value, int otherwise) { return value < 0 ? otherwise : value; };
  codec.color_primaries = static_cast<AVColorPrimaries>(
      known(libav().av_color_primaries_from_name(tags.primaries.c_str()), AVCOL_PRI_UNSPECIFIED));
  codec.color_trc = static_cast<AVColorTransferCharacteristic>(
      known(libav().av_color_transfer_from_name(tags.transfer.c_str()), AVCOL_TRC_UNSPECIFIED));
  if (is_rgb) {
    codec.colorspace = AVCOL_SPC_RGB;
    codec.color_range = AVCOL_RANGE_JPEG;
    return;
  }
  auto matrix =
      static_cast<AVColorSpace>(known(libav().av_color_space_from_name(tags.matrix.c_str()), AVCOL_SPC_UNSPECIFIED));
  if (matrix == AVCOL_SPC_RGB || matrix > AVCOL_SPC_BT2020_NCL) matrix = AVCOL_SPC_UNSPECIFIED;
  codec.colorspace = matrix_in_use(matrix, codec.width, codec.height);
  // Its pictures know no other, and decoders believe them more than the container.
  if (options.codec == "dnxhr" && codec.colorspace != AVCOL_SPC_BT2020_NCL) codec.colorspace = AVCOL_SPC_BT709;
  // ProRes has no full range: its readers do not ask.
  const bool is_prores = options.codec == "prores-hq" || options.codec == "prores-4444";
  codec.color_range = tags.range == "pc" && !is_prores ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
  codec.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

/// How fast libaom and libvpx are asked to be, for each of the presets.
int cpu_used(const FilmWriterOptions& options) {
  static constexpr std::array<int, 10> of_aom = {8, 8, 7, 7, 6, 6, 4, 3, 2, 1};
  static constexpr std::array<int, 10> of_vpx = {5, 5, 5, 4, 3, 2, 1, 1, 0, 0};
  const auto presets = encoder_presets();
  const auto place =
      static_cast<std::size_t>(std::ranges::find(presets, std::string_view(options.preset)) - presets.begin());
  return (options.codec == "av1" ? of_aom : of_vpx).at(place);
}

const char* dnxhr_profile(AVPixelFormat format) {
  if (format == AV_PIX_FMT_YUV422P) return "dnxhr_hq";
  return format == AV_PIX_FMT_YUV444P10LE ? "dnxhr_444" : "dnxhr_hqx";
}

void set_private_options(AVCodecContext& codec, const FilmWriterOptions& options, const VideoCoding& coding) {
  void* const own = codec.priv_data;
  if (coding.most_crf > 0) libav().av_opt_set_double(own, "crf", options.crf.value_or(coding.usual_crf), 0);
  if (coding.encoder == "libx264") {
    libav().av_opt_set(own, "preset", options.preset.c_str(), 0);
    std::string parameters = x264_processor();
    if (const auto packing = frame_packing_of(options.layout)) parameters += fmt::format(":frame-packing={}", *packing);
    // x264 takes six steps from the chroma of 4:4:4; who chooses that wants its chroma.
    if (codec.pix_fmt == AV_PIX_FMT_YUV444P) parameters += ":chroma-qp-offset=-6";
    libav().av_opt_set(own, "x264-params", parameters.c_str(), 0);
  } else if (coding.encoder == "libx265") {
    libav().av_opt_set(own, "preset", options.preset.c_str(), 0);
    // Its own threads; libav's setting is how many frames at a time.
    libav().av_opt_set(own, "x265-params", "log-level=none:pools=4", 0);
  } else if (coding.encoder == "prores_ks") {
    libav().av_opt_set(own, "profile", options.codec == "prores-4444" ? "4444" : "hq", 0);
    libav().av_opt_set(own, "vendor", "apl0", 0);  // editors doubt films of other makers
  } else if (coding.encoder == "dnxhd") {
    libav().av_opt_set(own, "profile", dnxhr_profile(codec.pix_fmt), 0);
  } else if (coding.encoder == "ffv1") {
    codec.level = 3;
    codec.slices = 4;
    codec.gop_size = 1;
    libav().av_opt_set_int(own, "slicecrc", 1, 0);
  } else {  // libaom, libvpx
    libav().av_opt_set_int(own, "cpu-used", cpu_used(options), 0);
    if (options.codec == "vp9") libav().av_opt_set_int(own, "tile-columns", 2, 0);  // what its threads share
    codec.bit_rate = 0;                                                             // the quality decides
  }
}

}  // namespace

void check_encoding(const FilmWriterOptions& options) {
  const VideoCoding& coding = coding_of(options);
  pixel_format_of(options);
  check_projection(options.projection);
  if (options.crf && coding.most_crf <= 0)
    refuse(fmt::format("crf: {} has no rate factor, expected none", coding.name));
  if (options.crf && !(*options.crf >= 0 && *options.crf <= coding.most_crf))
    refuse(fmt::format("crf: {}, expected 0 (best) to {}", *options.crf, coding.most_crf));
  const auto presets = encoder_presets();
  if (std::ranges::find(presets, std::string_view(options.preset)) == presets.end())
    refuse(fmt::format("preset: {}, expected {}", options.preset, fmt::join(presets, ", ")));
  check_encoder(coding);
}

void note_padding(ImageView<const Rgb8> picture, const AVCodecContext& codec, std::vector<std::string>& notes) {
  if (codec.width == picture.width() && codec.height == picture.height()) return;
  notes.push_back(fmt::format("{}x{} pixels become {}x{} by repeating the last column or row: chroma needs even sizes",
                              picture.width(), picture.height(), codec.width, codec.height));
}

VideoEncoder::VideoEncoder(const FilmWriterOptions& options, int width, int height, Rational time_base) {
  check_encoding(options);
  const VideoCoding& coding = coding_of(options);
  if (width < coding.least_width || height < coding.least_height)
    refuse(fmt::format("{} cannot encode {}x{} pixels, expected at least {}x{}", coding.name, width, height,
                       coding.least_width, coding.least_height));
  const AVCodec* encoder = libav().avcodec_find_encoder_by_name(std::string(coding.encoder).c_str());
  codec_.reset(libav().avcodec_alloc_context3(encoder));
  if (!codec_) throw std::bad_alloc();
  AVCodecContext& codec = *codec_;
  codec.pix_fmt = pixel_format_of(options);
  const AVPixFmtDescriptor& format = *libav().av_pix_fmt_desc_get(codec.pix_fmt);
  codec.width = rounded_up(width, format.log2_chroma_w);
  codec.height = rounded_up(height, format.log2_chroma_h);
  codec.time_base = as_av(time_base);
  codec.framerate = options.frame_rate.numerator > 0 ? as_av(options.frame_rate) : AVRational{25, 1};
  const Rational of_layout = pixel_aspect_of(options.layout);
  codec.sample_aspect_ratio = as_av(of_layout == Rational{1, 1} ? options.pixel_aspect : of_layout);
  codec.thread_count = coding.threads;
  // The header goes into the container; nothing in the packets tells when or where they were made.
  codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  tag_colours(codec, options, (format.flags & AV_PIX_FMT_FLAG_RGB) != 0);
  set_private_options(codec, options, coding);
  require_address_space(bytes_of_encoder(options.codec, width, height));
  const int error = libav().avcodec_open2(&codec, encoder, nullptr);
  if (error < 0) {
    refuse(fmt::format("{} cannot encode {}x{} pixels as {}: {}", coding.name, codec.width, codec.height, format.name,
                       libav_reason(error)));
  }
  frame_from_rgb_.emplace(codec.width, codec.height, codec.pix_fmt, codec.colorspace, codec.color_range);
  if (is_deep(codec.pix_fmt))
    frame_from_deep_.emplace(codec.width, codec.height, codec.pix_fmt, codec.colorspace, codec.color_range);
}

OwnedFrame VideoEncoder::to_code(const Frame& frame) {
  if (frame_from_deep_ && !frame.deep.empty()) return frame_from_deep_->convert(frame.deep);
  return frame_from_rgb_->convert(frame.picture);
}

void VideoEncoder::send(const Frame& frame, const PacketSink& sink) {
  const OwnedFrame coded = to_code(frame);
  coded->pts = frame.pts;
  coded->pkt_duration = frame.duration;
  coded->colorspace = codec_->colorspace;
  coded->color_range = codec_->color_range;
  coded->color_primaries = codec_->color_primaries;
  coded->color_trc = codec_->color_trc;
  coded->sample_aspect_ratio = codec_->sample_aspect_ratio;
  durations_[frame.pts] = frame.duration;
  ++sent_;
  const int error = libav().avcodec_send_frame(codec_.get(), coded.get());
  if (error < 0) throw Error(ErrorKind::cannot_read_write, fmt::format("encoder: {}", libav_reason(error)));
  receive(sink);
}

void VideoEncoder::drain(const PacketSink& sink) {
  libav().avcodec_send_frame(codec_.get(), nullptr);
  receive(sink);
}

void VideoEncoder::receive(const PacketSink& sink) {
  while (true) {
    const int error = libav().avcodec_receive_packet(codec_.get(), packet_.get());
    if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return;
    if (error < 0) throw Error(ErrorKind::cannot_read_write, fmt::format("encoder: {}", libav_reason(error)));
    // libx265 3.5 never sets the decoding times of films that are too short to be reordered
    // (github.com/Multicorewareinc/x265/issues/781).
    constexpr int reordered_frames = 3;
    if (codec_->codec_id == AV_CODEC_ID_HEVC && sent_ < reordered_frames) packet_->dts = packet_->pts;
    if (const auto duration = durations_.extract(packet_->pts)) packet_->duration = duration.mapped();
    sink(*packet_);
    libav().av_packet_unref(packet_.get());
  }
}

}  // namespace wheatstone
