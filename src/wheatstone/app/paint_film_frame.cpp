#include <utility>

#include "wheatstone/app/paint_film_frame_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone {
namespace {

/// The shot whose frame this still is, although the next one has begun.
void follow_dissolve(const RotoscopeFilmOptions& options, FilmState& state) {
  const std::optional<Dissolve> dissolve = dissolve_at(options.shots, state.shot.frames);
  if (!dissolve) {
    state.outgoing.reset();
  } else if (begins_shot(options.shots, state.shot.frames)) {
    state.outgoing = state.shot;
  }
}

}  // namespace

PaintedFilmFrame paint_film_frame(StereoFrame& frame, const RotoscopeFilmOptions& options, bool draws, FilmState& state,
                                  const Progress& progress) {
  StereoPair eyes{std::move(frame.left), std::move(frame.right)};
  const std::int64_t number = state.shot.frames;
  const double at_s = seconds_of(frame);
  std::optional<KnownFrame> known;
  if (options.known) known = options.known(number, eyes);
  if (known && known->flow && !options.ranks.alone())
    throw Error(ErrorKind::wrong_usage, "frames whose flow is known are painted in one process, not under mpirun");
  std::optional<FrameMask> mask;
  if (options.mask) mask = options.mask(number, eyes.left);
  const KnownFrame* const known_frame = known ? &*known : nullptr;
  const FrameMask* const frame_mask = mask ? &*mask : nullptr;
  const auto paint = [&](const RotoscopeOptions& of_frame, RotoscopeState& of_shot) {
    const ImageView<const Rgb16> deep = frame.left_deep;
    if (draws) return rotoscope_frame(eyes, of_frame, of_shot, known_frame, progress, frame_mask, deep);
    return RotoscopedFrame{plan_film_frame(eyes, of_frame, of_shot, known_frame, progress, frame_mask, deep), {}};
  };
  const StereoLayout layout = options.right_film.empty() ? options.writing.layout : StereoLayout::left_right;
  const auto in_film = [&](RotoscopedFrame& painted) {
    return frame_in_film(std::move(static_cast<DrawnFrame&>(painted)), layout, options.anaglyph);
  };
  follow_dissolve(options, state);
  PaintedFilmFrame made;
  if (const std::optional<Dissolve> dissolve = dissolve_at(options.shots, number)) {
    made.outgoing = paint(options_of_shot(options.frames, *dissolve->outgoing, at_s), *state.outgoing);
    made.share = dissolve->share;
  }
  made.shot = paint(options_of_frame(options.frames, options.shots, number, at_s), state.shot);
  if (draws) made.frame = in_film(made.shot);
  if (draws && made.outgoing) dissolve_from(in_film(*made.outgoing), made.share, made.frame);
  frame.left = std::move(eyes.left);
  frame.right = std::move(eyes.right);
  return made;
}

void repeat_film_frame(const PaintedFilmFrame& before, FilmState& state) {
  repeat_film_frame(before.shot, state.shot);
  if (before.outgoing && state.outgoing) repeat_film_frame(*before.outgoing, *state.outgoing);
}

Frame frame_at(Frame frame, const StereoFrame& source) {
  frame.pts = source.pts;
  frame.time_base = source.time_base;
  frame.duration = source.duration;
  return frame;
}

}  // namespace wheatstone
