#pragma once

#include <optional>

#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/video/frame.h"

namespace wheatstone {

/// A frame of a painted film. Planned only, it has no pictures.
struct PaintedFilmFrame {
  RotoscopedFrame shot;
  std::optional<RotoscopedFrame> outgoing;  ///< the same moment, as the shot paints it that dissolves into this one
  float share = 1;                          ///< of the shot's picture in `frame`; the rest is the outgoing one's
  Frame frame;                              ///< as the film has it, without its time
};

/// Paints a frame that was read, or only plans it; in a dissolve as two shots. Its pictures stay for reading the next
/// one into. Throws as rotoscope_frame, and Error{wrong_usage} where the flow is known and several ranks paint.
PaintedFilmFrame paint_film_frame(StereoFrame& frame, const RotoscopeFilmOptions& options, bool draws, FilmState& state,
                                  const Progress& progress);

/// Goes on by a frame that shows the painting of the one before again.
void repeat_film_frame(const PaintedFilmFrame& before, FilmState& state);

/// The frame at the time of `source`.
Frame frame_at(Frame frame, const StereoFrame& source);

}  // namespace wheatstone
