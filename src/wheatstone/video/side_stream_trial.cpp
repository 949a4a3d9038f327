#include <new>

#include "wheatstone/video/side_streams_internal.h"

namespace wheatstone {
namespace {

/// Enough to know how a stream is coded and that its packets are what they are said to be.
constexpr std::size_t most_packets = 24;
constexpr int most_packets_read = 4000;

struct CloseOutput {
  void operator()(AVFormatContext* output) const {
    std::uint8_t* bytes = nullptr;
    if (output->pb != nullptr) libav().avio_close_dyn_buf(output->pb, &bytes);
    libav().av_free(bytes);
    libav().avformat_free_context(output);
  }
};

/// The first packets of each stream.
std::map<int, std::vector<OwnedPacket>> first_packets(const std::filesystem::path& source) {
  const OwnedInput input = open_input(source);
  for (unsigned i = 0; i < input->nb_streams; ++i) {
    const AVMediaType type = input->streams[i]->codecpar->codec_type;
    const bool is_of_use = type == AVMEDIA_TYPE_AUDIO || type == AVMEDIA_TYPE_SUBTITLE;
    input->streams[i]->discard = is_of_use ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
  }
  std::map<int, std::vector<OwnedPacket>> packets;
  OwnedPacket packet = new_packet();
  for (int read = 0; read < most_packets_read && libav().av_read_frame(input.get(), packet.get()) >= 0; ++read) {
    std::vector<OwnedPacket>& of_stream = packets[packet->stream_index];
    if (of_stream.size() < most_packets) {
      of_stream.push_back(std::move(packet));
      packet = new_packet();
    } else {
      libav().av_packet_unref(packet.get());
    }
  }
  return packets;
}

}  // namespace

SideStreamTrial::SideStreamTrial(const std::filesystem::path& source, const AVOutputFormat& format)
    : packets_(first_packets(source)), format_(format) {}

int SideStreamTrial::error_of(const AVStream& from) {
  AVFormatContext* made = nullptr;
  if (libav().avformat_alloc_output_context2(&made, &format_, nullptr, nullptr) < 0) throw std::bad_alloc();
  const std::unique_ptr<AVFormatContext, CloseOutput> output(made);
  output->flags |= AVFMT_FLAG_BITEXACT;
  output->strict_std_compliance = FF_COMPLIANCE_EXPERIMENTAL;
  CopiedStream target(*output, from);
  int error = libav().avio_open_dyn_buf(&output->pb);
  if (error >= 0) error = libav().avformat_write_header(output.get(), nullptr);
  if (error < 0) return error;
  for (OwnedPacket& packet : packets_[from.index]) {
    target.fit(*packet, from.time_base, 0);
    error = libav().av_interleaved_write_frame(output.get(), packet.get());
    if (error < 0) return error;
  }
  return libav().av_write_trailer(output.get());
}

}  // namespace wheatstone
