#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {
#include <libavutil/frame.h>
#include <libavutil/rational.h>
}

namespace wheatstone {

/// Makes whole frames of fields: libavfilter's bwdif, a frame for a frame, with the order of the fields that each frame
/// says. Frames that are not interlaced stay as they are. A frame comes when the next one was given.
class Deinterlacer {
 public:
  virtual ~Deinterlacer() = default;
  /// Nothing: no frame follows. Returns libav's error, or 0.
  virtual int send(const AVFrame* frame) = 0;
  /// 0, AVERROR(EAGAIN) where a frame must be given before, AVERROR_EOF after the last.
  virtual int receive(AVFrame& frame) = 0;
};

/// For frames like `first`; none where libavfilter fails. It is of a module, because the libraries behind libavfilter
/// take longer to load than all others together.
using OpenDeinterlacer = Deinterlacer*(const AVFrame& first, AVRational time_base, int threads);
inline constexpr auto avfilter_module_name = "wheatstone_avfilter";
inline constexpr std::size_t avfilter_module_bytes = std::size_t{192} << 20;
inline constexpr auto open_deinterlacer_name = "wheatstone_open_deinterlacer";

}  // namespace wheatstone
