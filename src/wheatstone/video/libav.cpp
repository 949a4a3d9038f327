#include <fmt/format.h>

#include <array>
#include <new>

#include "wheatstone/error.h"
#include "wheatstone/files/module.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr const char* containers =
    "mov,mp4,matroska,webm,avi,gif,mpegts,mpeg,mpegvideo,m4v,h264,hevc,asf,flv,ogg,nut,mxf,ivf,obu,dv,wtv,rm,"
    "yuv4mpegpipe";

}  // namespace

const LibavFunctions& libav() {
  static const LibavFunctions* const loaded =
      reinterpret_cast<GiveLibav*>(function_of_module(libav_module_name, give_libav_name, libav_module_bytes))();
  return *loaded;
}

OwnedFrame new_frame() {
  OwnedFrame frame(libav().av_frame_alloc());
  if (!frame) throw std::bad_alloc();
  return frame;
}

OwnedPacket new_packet() {
  OwnedPacket packet(libav().av_packet_alloc());
  if (!packet) throw std::bad_alloc();
  return packet;
}

OwnedParameters parameters_of(const AVCodecContext& encoder) {
  OwnedParameters parameters(libav().avcodec_parameters_alloc());
  if (!parameters || libav().avcodec_parameters_from_context(parameters.get(), &encoder) < 0) throw std::bad_alloc();
  return parameters;
}

std::string libav_reason(int error) {
  // "Try again" is what it says where a thread cannot be started.
  if (error == AVERROR(ENOMEM) || error == AVERROR(EAGAIN)) throw std::bad_alloc();
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  libav().av_strerror(error, text.data(), text.size());
  return text.data();
}

void refuse_film(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
}

void fail_to_write_film(const fs::path& path, int error) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write: {}", path.string(), libav_reason(error)));
}

OwnedInput open_input(const fs::path& path) {
  check_plain_file(path, "a film");
  AVDictionary* options = nullptr;
  libav().av_dict_set(&options, "format_whitelist", containers, 0);
  libav().av_dict_set(&options, "protocol_whitelist", "file", 0);
  AVFormatContext* opened = nullptr;
  // With the protocol said, a colon in a file's name is nothing special.
  const int error = libav().avformat_open_input(&opened, ("file:" + path.string()).c_str(), nullptr, &options);
  libav().av_dict_free(&options);
  if (error < 0) {
    refuse_film(path, fmt::format("no film, or a damaged one ({}); expected MP4, Matroska, AVI, MPEG, GIF or the like",
                                  libav_reason(error)));
  }
  OwnedInput input(opened);
  const int unknown = libav().avformat_find_stream_info(input.get(), nullptr);
  if (unknown < 0) refuse_film(path, fmt::format("its streams cannot be read: {}", libav_reason(unknown)));
  return input;
}

int video_stream_of(const AVFormatContext& input) {
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    const AVStream& stream = *input.streams[i];
    if (stream.codecpar->codec_type != AVMEDIA_TYPE_VIDEO) continue;
    if ((stream.disposition & AV_DISPOSITION_ATTACHED_PIC) == 0) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace wheatstone
