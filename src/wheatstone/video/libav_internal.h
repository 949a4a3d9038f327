#pragma once

// libav's objects with owners, its errors with words. Seen by .cpp files only, never installed.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "wheatstone/video/frame.h"
#include "wheatstone/video/libav_functions_internal.h"

namespace wheatstone {

struct LibavDeleter {
  void operator()(AVFrame* frame) const { libav().av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { libav().av_packet_free(&packet); }
  void operator()(AVCodecContext* codec) const { libav().avcodec_free_context(&codec); }
  void operator()(AVCodecParameters* parameters) const { libav().avcodec_parameters_free(&parameters); }
  void operator()(SwsContext* scaler) const { libav().sws_freeContext(scaler); }
};
using OwnedFrame = std::unique_ptr<AVFrame, LibavDeleter>;
using OwnedPacket = std::unique_ptr<AVPacket, LibavDeleter>;
using OwnedCodec = std::unique_ptr<AVCodecContext, LibavDeleter>;
using OwnedParameters = std::unique_ptr<AVCodecParameters, LibavDeleter>;
using OwnedScaler = std::unique_ptr<SwsContext, LibavDeleter>;

struct InputDeleter {
  void operator()(AVFormatContext* input) const { libav().avformat_close_input(&input); }
};
using OwnedInput = std::unique_ptr<AVFormatContext, InputDeleter>;

OwnedFrame new_frame();
OwnedPacket new_packet();
/// What an opened encoder makes.
OwnedParameters parameters_of(const AVCodecContext& encoder);

/// What libav's error number means, in its words.
std::string libav_reason(int error);

[[noreturn]] void refuse_film(const std::filesystem::path& path, std::string_view what);
[[noreturn]] void fail_to_write_film(const std::filesystem::path& path, int error);

/// Opens a film and finds its streams. Only formats that hold everything in the one file are let in: none that names
/// other files or addresses, none that takes any text for a film. Throws Error{bad_input}.
OwnedInput open_input(const std::filesystem::path& path);

/// The first stream of moving pictures (a cover is none), or −1.
int video_stream_of(const AVFormatContext& input);

inline AVRational as_av(Rational r) { return {r.numerator, r.denominator}; }
inline Rational from_av(AVRational r) { return r.den == 0 ? Rational{} : Rational{r.num, r.den}; }

}  // namespace wheatstone
