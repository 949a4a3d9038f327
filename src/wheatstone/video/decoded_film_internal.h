#pragma once

// The frames of one film file, one after the other, and what went wrong with them.

#include <memory>
#include <optional>

#include "wheatstone/video/deinterlacer_internal.h"
#include "wheatstone/video/film_reader.h"
#include "wheatstone/video/libav_internal.h"
#include "wheatstone/video/picture_conversion_internal.h"

namespace wheatstone {

/// When a frame is shown, in ticks of the film's time base.
struct FrameTime {
  std::int64_t pts = 0;
  std::int64_t duration = 0;
};

class DecodedFilm {
 public:
  /// Opens the film and decodes its first frame, which tells what the container may not. Throws Error{bad_input}.
  DecodedFilm(std::filesystem::path path, int threads);

  const FilmFacts& facts() const { return facts_; }

  /// Goes to the key frame at or before this moment, if the film can be searched. The first `step` then gives its
  /// frame.
  void seek_before(double seconds);

  /// Decodes the next frame. False after the last.
  bool step();
  /// Reads what remains, without decoding it. No frame is at hand then.
  void pass_over_rest();
  FrameTime time() const { return time_; }
  /// The frame that `step` came to.
  void convert(Image<Rgb8>& picture);
  /// The same with 16 bits a channel; empty where the film has 8.
  void convert_deep(Image<Rgb16>& picture);

  std::optional<std::string> loss() const;

 private:
  void open();
  void open_decoder(const AVStream& stream);
  void gather_facts();
  void gather_layout();
  void decode_afresh();
  void look_ahead();
  bool read_packet();
  int receive();
  void open_deinterlacer();
  void feed();
  std::int64_t usual_duration(std::int64_t said) const;
  FrameTime time_of(const AVFrame& frame) const;
  void check_size() const;
  double stated_end_s();

  std::filesystem::path path_;
  int threads_;
  OwnedInput input_;
  OwnedCodec decoder_;
  AVStream* stream_ = nullptr;
  OwnedPacket packet_ = new_packet();
  OwnedFrame frame_ = new_frame();              ///< the one at hand
  OwnedFrame ahead_ = new_frame();              ///< the one after it: only its time tells how long this one is shown
  std::unique_ptr<Deinterlacer> deinterlacer_;  ///< from the first interlaced frame on
  RgbFromFrame<Rgb8> rgb_from_frame_;
  RgbFromFrame<Rgb16> deep_from_frame_;
  FilmFacts facts_;
  PictureTurn orientation_;
  FrameTime time_;
  FrameTime latest_;                     ///< of the packets that were read
  std::optional<FrameTime> time_ahead_;  ///< nothing where no frame follows

  bool fed_all_ = false;   ///< the decoder was told that nothing follows
  bool at_end_ = false;    ///< the last frame was passed
  bool searched_ = false;  ///< frames were passed over: their number says nothing
  int stored_width_ = 0;
  int stored_height_ = 0;
  std::int64_t packets_ = 0;
  std::int64_t damaged_ = 0;
  bool stream_states_end_ = false;  ///< the length is the pictures' own, not the longest stream's
  int read_error_ = 0;              ///< that ended the reading, where it was not the end of the file
};

}  // namespace wheatstone
