#include "wheatstone/app/rotoscope_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <mutex>
#include <system_error>

#include "wheatstone/app/marks_sequence_internal.h"
#include "wheatstone/app/rotoscope_state_file.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/struct_fields_internal.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/segmented_film.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads of this process.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The sources of the film's bytes, the networks among them.
std::vector<fs::path> sources_of(const RotoscopeFilmOptions& options) {
  std::vector<fs::path> sources = options.made_from;
  for (const fs::path& network : {options.frames.matching.model, options.frames.flow_model})
    if (!network.empty()) sources.push_back(network);
  return sources;
}

/// Where frames go: a film that is being made, or only files of marks.
class Output {
 public:
  Output(const fs::path& path, const RotoscopeFilmOptions& options)
      : path_(path), layout_(options.writing.layout), frames_between_checkpoints_(options.frames_between_checkpoints) {
    const bool only_marks = path.extension() == ".wst";
    if (only_marks && options.resume)
      throw Error(ErrorKind::wrong_usage, "a run that writes only marks cannot be resumed: write a film too");
    const fs::path marks = only_marks ? path : options.marks;
    if (!marks.empty()) check_marks(marks);
    if (!only_marks)
      film_.emplace(
          path, options.writing,
          SegmentOptions{options.frames_between_checkpoints, recipe_of(options), sources_of(options), options.resume});
    if (!marks.empty()) open_marks(marks);
  }

  /// Frames that are safe: an earlier run has left them, or this one has closed them.
  std::int64_t frames_done() const { return film_ ? film_->frames_done() : 0; }

  /// After the frames that are done.
  RotoscopeState state() const {
    return frames_done() > 0 ? read_rotoscope_state(state_file(frames_done())) : RotoscopeState();
  }

  void write(const RotoscopedFrame& frame, const StereoFrame& source, const RotoscopeState& state) {
    const PaintedPair& painted = frame.painted;
    if (marks_) marks_->write(state.frames, painted.painting);
    if (!film_) return;
    const bool at_checkpoint = state.frames % frames_between_checkpoints_ == 0;
    // Before the segment of these frames is closed: each closed segment has its state.
    if (at_checkpoint) write_rotoscope_state(state_file(state.frames), state);
    // The film's frames and their marks are kept together.
    std::unique_lock<std::recursive_mutex> hold;
    if (at_checkpoint) hold = hold_outputs();
    const Image<Rgb8>&left = painted.pictures.left, &right = painted.pictures.right;
    film_->write(
        {right.empty() ? left : put_together(left, right, layout_), source.pts, source.time_base, source.duration});
    if (!at_checkpoint) return;
    if (marks_) marks_->keep();
    std::error_code ignored;
    fs::remove(state_file(state.frames - frames_between_checkpoints_), ignored);
  }

  std::vector<std::string> finish(const RotoscopeState& state, const Progress& progress) {
    // From the film's name to those of the marks nothing may end the program.
    const auto hold = hold_outputs();
    if (film_) {
      // Joining closes the last segment, and may be stopped, too.
      if (state.frames > frames_done()) write_rotoscope_state(state_file(state.frames), state);
      if (marks_) marks_->check(state.frames);
      const RotoscopeTotals& totals = state.totals;
      if (totals.moved_frames > 0) film_->set_comment(moved_eyes_note(totals.moved_frames, totals.least_separation));
      film_->finish(progress);
    }
    if (marks_) marks_->give_names(state.frames);
    return film_ ? film_->notes() : std::vector<std::string>();
  }

  /// What cannot be gone on with is not kept.
  void discard() {
    if (marks_) marks_->discard();
    if (film_) film_->discard();
  }

 private:
  void open_marks(const fs::path& path) {
    try {
      marks_.emplace(path, frames_done());
    } catch (const Error&) {
      // Nothing was painted yet: nothing stays.
      if (film_ && frames_done() == 0) film_->discard();
      throw;
    }
  }

  static void check_marks(const fs::path& path) {
    const std::optional<FramePattern> pattern = frame_pattern(path);
    if (!pattern)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: has no frame number pattern, expected a name like marks_%04d.wst", path.string()));
    const std::vector<std::int64_t> existing = numbers_of(*pattern);
    if (!existing.empty())
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: {} exists already, expected no such file, because frames of two runs would be mixed",
                              path.string(), pattern->file(existing.front()).filename().string()));
  }

  fs::path state_file(std::int64_t frames) const { return work_folder_of(path_) / fmt::format("state_{:09}", frames); }

  fs::path path_;
  StereoLayout layout_;
  int frames_between_checkpoints_;
  std::optional<SegmentedFilm> film_;
  std::optional<MarksSequence> marks_;
};

/// "painting frame 12 of 240, 2.10 a second".
std::string step_text(std::int64_t frame, std::int64_t expected, std::int64_t done_before, double seconds) {
  const auto painted = static_cast<double>(frame - done_before);
  std::string text =
      expected > 0 ? fmt::format("painting frame {} of {}", frame, expected) : fmt::format("painting frame {}", frame);
  if (painted >= 1 && seconds > 0) text += fmt::format(", {:.2f} a second", painted / seconds);
  return text;
}

void add(const RotoscopedFrame& frame, RotoscopedFilm& film) {
  film.times.matching_s += frame.times.matching_s;
  film.times.central_s += frame.times.central_s;
  film.times.flow_s += frame.times.flow_s;
  film.painting_times.planning_s += frame.painted.times.planning_s;
  film.painting_times.rasterising_s += frame.painted.times.rasterising_s;
}

RotoscopedFilm paint_frames(StereoFilmReader& source, Output& output, const RotoscopeFilmOptions& options,
                            const Progress& progress, RotoscopeState& state) {
  RotoscopedFilm film;
  film.resumed_frames = source.skip(output.frames_done());
  if (film.resumed_frames > 0) report(progress, "resuming", 0);
  const std::int64_t expected = options.expected_frames;
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processor_seconds();
  film.frames = film.resumed_frames;
  for (StereoFrame frame; source.read(frame); ++film.frames) {
    const std::string text = step_text(film.frames, expected, film.resumed_frames, seconds_since(start));
    const double share =
        expected > 0 ? std::min(static_cast<double>(film.frames) / static_cast<double>(expected), 1.0) : 0;
    // The steps within a frame are asked only whether to go on.
    const Progress within = [&](std::string_view, double) { report(progress, text, share); };
    within("", 0);
    StereoPair eyes{std::move(frame.left), std::move(frame.right)};
    std::optional<KnownFrame> known;
    if (options.known) known = options.known(film.frames, eyes.left);
    const RotoscopedFrame painted = rotoscope_frame(eyes, options.frames, state, known ? &*known : nullptr, within);
    output.write(painted, frame, state);
    add(painted, film);
    if (!painted.rows_note.empty())
      film.notes.push_back(fmt::format("from frame {} on, {}", film.frames, painted.rows_note));
    frame.left = std::move(eyes.left);
    frame.right = std::move(eyes.right);
  }
  if (film.frames == 0) throw Error(ErrorKind::wrong_usage, "the film has no frame in the requested time range");
  film.totals = state.totals;
  film.seconds = seconds_since(start);
  film.core_seconds = processor_seconds() - processor_start;
  return film;
}

}  // namespace

std::string recipe_of(const RotoscopeFilmOptions& options) {
  // Whoever adds a member says here whether it decides a byte. Not in the text: `writing` and the interval, which the
  // film's segments compare themselves, the sources, which are compared by what is in them, and what only says how
  // the run goes: resume, keep_going, expected_frames.
  static_assert(field_count<RotoscopeFilmOptions>() == 11);
  RotoscopeOptions frames = options.frames;
  frames.matching.model.clear();  // their content is compared
  frames.flow_model.clear();
  FilmReaderOptions reading = options.reading;
  reading.threads = 0;  // the same frames on any number
  return fmt::format("{}\n{}\n{}\nmarks {}\nknown {}", options.made_by, text_of_fields(frames), text_of_fields(reading),
                     options.marks.string(), static_cast<bool>(options.known));
}

std::optional<std::string> unfinished_film(const fs::path& output, const fs::path& marks) {
  const std::int64_t frames = frames_kept(output);
  if (frames == 0) return std::nullopt;
  std::string folders = work_folder_of(output).string();
  if (!marks.empty()) folders += " and " + work_folder_of(marks).string();
  return fmt::format("the first {} frames are kept in {}", frames, folders);
}

RotoscopedFilm rotoscope_film(StereoFilmReader& source, const fs::path& output, const RotoscopeFilmOptions& options,
                              const Progress& progress) {
  Output out(output, options);
  // A rest that is damaged is named and not removed: what it was worth is for the user to say.
  RotoscopeState state = out.state();
  RotoscopedFilm film;
  bool painted = false;
  try {
    film = paint_frames(source, out, options, progress, state);
    painted = true;
    report(progress, "joining", 0);
    for (std::string& note : out.finish(state, progress)) film.notes.push_back(std::move(note));
  } catch (const Error& error) {
    const bool can_go_on =
        painted || error.kind() == ErrorKind::interrupted || error.kind() == ErrorKind::cannot_read_write;
    const std::int64_t kept = out.frames_done();
    if (!can_go_on || kept == 0) out.discard();
    if (error.kind() == ErrorKind::interrupted && kept > 0)
      throw UnfinishedFilm(
          ErrorKind::interrupted,
          fmt::format("interrupted; {}", unfinished_film(output, options.marks).value_or("nothing is kept")));
    throw;
  }
  film.loss = source.loss();
  if (film.loss && !options.keep_going)
    throw Error(ErrorKind::bad_input, fmt::format("{}; the {} frames that could be decoded were painted to {}",
                                                  *film.loss, film.frames, output.string()));
  return film;
}

}  // namespace wheatstone
