#include "wheatstone/app/rotoscope_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <system_error>

#include "wheatstone/app/rotoscope_state_file.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/marks/style_parameters.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads of this process.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Everything that decides the frames, as text.
std::string recipe_of(const RotoscopeFilmOptions& options) {
  const RotoscopeOptions& frames = options.frames;
  const MatchOptions& matching = frames.matching;
  const CarryOptions& carrying = frames.carrying;
  const DisparityRange range = matching.range.value_or(DisparityRange{0, 0});
  return fmt::format(
      "{}\n{}\nseed {}\nmatching {} {} {} {} {} {} {} {} {} {} {} {} {} {}\nflow {} central {} anew {}\n"
      "carrying {} {} {} {} {}",
      options.made_by, style_to_toml(frames.style), frames.style.seed, static_cast<int>(matching.matcher),
      matching.model.string(), matching.range.has_value(), range.least, range.largest, matching.block_px,
      matching.left_right_check, matching.check_tolerance_px, matching.least_surface_px, matching.size,
      matching.distrust, matching.wls, matching.wls_keeps_confirmed, options.known != nullptr,
      static_cast<int>(frames.flow), static_cast<int>(frames.central), frames.anew, carrying.fade_in_frames,
      carrying.fade_out_frames, carrying.colour_tolerance, carrying.gain_tolerance, carrying.length_tolerance);
}

/// Where frames go: a film that is being made, or only files of marks.
class Output {
 public:
  Output(const fs::path& path, const RotoscopeFilmOptions& options)
      : path_(path),
        layout_(options.writing.layout),
        frames_between_checkpoints_(options.frames_between_checkpoints),
        style_(options.frames.style) {
    const bool only_marks = path.extension() == ".wst";
    const fs::path marks = only_marks ? path : options.marks;
    if (!marks.empty()) {
      marks_ = frame_pattern(marks);
      if (!marks_)
        throw Error(ErrorKind::wrong_usage,
                    fmt::format("{}: needs a place for the frame's number, as marks_%04d.wst", marks.string()));
    }
    if (only_marks && options.resume)
      throw Error(ErrorKind::wrong_usage, "marks alone cannot be resumed: write a film beside them");
    if (only_marks) return;
    check_rest(options.resume);
    film_.emplace(path, options.writing,
                  SegmentOptions{options.frames_between_checkpoints, recipe_of(options), options.made_from});
  }

  /// Frames that are safe: an earlier run has left them, or this one has closed them.
  std::int64_t frames_done() const { return film_ ? film_->frames_done() : 0; }

  /// After the frames that are done.
  RotoscopeState state() const {
    return frames_done() > 0 ? read_rotoscope_state(state_file(frames_done())) : RotoscopeState();
  }

  void write(const RotoscopedFrame& frame, const StereoFrame& source, const RotoscopeState& state) {
    const PaintedPair& painted = frame.painted;
    if (marks_) write_painting(marks_->file(state.frames), marks_of(painted, style_));
    if (!film_) return;
    const bool at_checkpoint = state.frames % frames_between_checkpoints_ == 0;
    // Before the segment of these frames is closed: each closed segment has its state.
    if (at_checkpoint) write_rotoscope_state(state_file(state.frames), state);
    Image<Rgb8> picture = painted.pictures.right.empty()
                              ? painted.pictures.left
                              : put_together(painted.pictures.left, painted.pictures.right, layout_);
    film_->write({std::move(picture), source.pts, source.time_base, source.duration});
    if (!at_checkpoint) return;
    std::error_code ignored;
    fs::remove(state_file(state.frames - frames_between_checkpoints_), ignored);
  }

  std::vector<std::string> finish(const RotoscopeState& state, const Progress& progress) {
    if (!film_) return {};
    // Joining closes the last segment, and may be stopped, too.
    if (state.frames > frames_done()) write_rotoscope_state(state_file(state.frames), state);
    film_->finish(progress);
    return film_->notes();
  }

  /// What cannot be gone on with is not kept.
  void abandon() {
    if (!film_) return;
    film_.reset();
    std::error_code ignored;
    fs::remove_all(segment_folder(path_), ignored);
  }

 private:
  void check_rest(bool resume) const {
    std::error_code ignored;
    if (!resume && fs::exists(segment_folder(path_) / "manifest.json", ignored))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: left by a run that did not finish; --resume goes on with it, or remove it",
                              segment_folder(path_).string()));
  }

  fs::path state_file(std::int64_t frames) const { return segment_folder(path_) / fmt::format("state_{:09}", frames); }

  fs::path path_;
  StereoLayout layout_;
  int frames_between_checkpoints_;
  Style style_;
  std::optional<FramePattern> marks_;
  std::optional<SegmentedFilm> film_;
};

/// "frame 12 of 240, 2.1 a second, 1:48 left".
std::string step_text(std::int64_t frame, std::int64_t expected, std::int64_t done_before, double seconds) {
  const auto painted = static_cast<double>(frame - done_before);
  std::string text =
      expected > 0 ? fmt::format("painting frame {} of {}", frame, expected) : fmt::format("painting frame {}", frame);
  if (painted < 1 || seconds <= 0) return text;
  const double rate = painted / seconds;
  text += fmt::format(", {:.2f} a second", rate);
  if (expected > frame) {
    const auto left = static_cast<std::int64_t>(std::llround(static_cast<double>(expected - frame) / rate));
    text += left >= 3600 ? fmt::format(", {}:{:02}:{:02} left", left / 3600, left / 60 % 60, left % 60)
                         : fmt::format(", {}:{:02} left", left / 60, left % 60);
  }
  return text;
}

void add(const RotoscopedFrame& frame, RotoscopedFilm& film) {
  film.times.matching_s += frame.times.matching_s;
  film.times.central_s += frame.times.central_s;
  film.times.flow_s += frame.times.flow_s;
  film.painting_times.planning_s += frame.painted.times.planning_s;
  film.painting_times.rasterising_s += frame.painted.times.rasterising_s;
}

void paint_frames(StereoFilmReader& source, Output& output, const RotoscopeFilmOptions& options,
                  const Progress& progress, RotoscopeState& state, RotoscopedFilm& film) {
  film.resumed_frames = source.skip(output.frames_done());
  if (film.resumed_frames > 0) report(progress, "going on", 0);
  const std::int64_t expected = options.expected_frames;
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processor_seconds();
  film.frames = film.resumed_frames;
  for (StereoFrame frame; source.read(frame); ++film.frames) {
    report(progress, step_text(film.frames, expected, film.resumed_frames, seconds_since(start)),
           expected > 0 ? std::min(static_cast<double>(film.frames) / static_cast<double>(expected), 1.0) : 0);
    StereoPair eyes{std::move(frame.left), std::move(frame.right)};
    std::optional<KnownFrame> known;
    if (options.known) known = options.known(film.frames);
    const RotoscopedFrame painted = rotoscope_frame(eyes, options.frames, state, known ? &*known : nullptr);
    output.write(painted, frame, state);
    add(painted, film);
    frame.left = std::move(eyes.left);
    frame.right = std::move(eyes.right);
  }
  if (film.frames == 0) throw Error(ErrorKind::wrong_usage, "the film has no frame in the time asked for");
  film.totals = state.totals;
  film.seconds = seconds_since(start);
  film.core_seconds = processor_seconds() - processor_start;
}

}  // namespace

RotoscopedFilm rotoscope_film(StereoFilmReader& source, const fs::path& output, const RotoscopeFilmOptions& options,
                              const Progress& progress) {
  Output out(output, options);
  // A rest that is damaged is named and not removed: what it was worth is for the user to say.
  RotoscopeState state = out.state();
  RotoscopedFilm film;
  bool painted = false;
  try {
    paint_frames(source, out, options, progress, state, film);
    painted = true;
    report(progress, "joining", 0);
    film.notes = out.finish(state, progress);
  } catch (const Error& error) {
    const bool can_go_on =
        painted || error.kind() == ErrorKind::interrupted || error.kind() == ErrorKind::cannot_read_write;
    const std::int64_t kept = out.frames_done();
    if (!can_go_on || kept == 0) out.abandon();
    if (error.kind() == ErrorKind::interrupted && kept > 0)
      throw Error(ErrorKind::interrupted, fmt::format("interrupted; --resume goes on after the first {} frames", kept));
    throw;
  }
  film.loss = source.loss();
  if (film.loss && !options.keep_going)
    throw Error(ErrorKind::bad_input, fmt::format("{}; the {} frames that could be decoded are painted in {}",
                                                  *film.loss, film.frames, output.string()));
  return film;
}

}  // namespace wheatstone
