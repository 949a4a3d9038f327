#pragma once

// Pictures to packets of a codec. Nothing of files.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "wheatstone/video/decoded_film_internal.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/libav_internal.h"
#include "wheatstone/video/picture_conversion_internal.h"

namespace wheatstone {

/// Takes a coded picture; its times are in the encoder's time base.
using PacketSink = std::function<void(AVPacket& packet)>;

/// Throws Error{wrong_usage} where codec, quality, preset or pixel format make no sense, alone or together.
void check_encoding(const FilmWriterOptions& options);

/// Says so where the encoder takes more pixels than the picture has.
void note_padding(ImageView<const Rgb8> picture, const AVCodecContext& codec, std::vector<std::string>& notes);

class VideoEncoder {
 public:
  /// Throws Error{wrong_usage} where the encoder refuses.
  VideoEncoder(const FilmWriterOptions& options, int width, int height, Rational time_base);

  /// Codes a frame of the size given, with as many bits as it has and the codec takes; packets come when the encoder
  /// has looked far enough ahead. Later frames have larger pts.
  void send(const Frame& frame, const PacketSink& sink);
  /// Gives what is still inside.
  void drain(const PacketSink& sink);

  const AVCodecContext& context() const { return *codec_; }

 private:
  OwnedFrame to_code(const Frame& frame);
  void receive(const PacketSink& sink);

  OwnedCodec codec_;
  std::optional<FrameFromRgb<Rgb8>> frame_from_rgb_;
  std::optional<FrameFromRgb<Rgb16>> frame_from_deep_;  ///< of codecs with more than 8 bits
  OwnedPacket packet_ = new_packet();
  int sent_ = 0;                                    ///< frames
  std::map<std::int64_t, std::int64_t> durations_;  ///< of frames inside, by pts: encoders forget them
};

}  // namespace wheatstone
