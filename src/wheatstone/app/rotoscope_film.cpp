#include "wheatstone/app/rotoscope_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <system_error>

#include "wheatstone/app/film_output_internal.h"
#include "wheatstone/app/paint_film_frame_internal.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/passed_frames_internal.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/struct_fields.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/video/segmented_film.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time of all threads of this process.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Whether a frame shows the painting of the one before. Pairs are those of the whole film, so that none of them lies
/// across a checkpoint or across what two ranks paint.
bool is_repeated(const RotoscopeFilmOptions& options, std::int64_t frame) {
  return options.on_twos && frame % 2 == 1 && !begins_shot(options.shots, frame) && !has_maps(options.shots, frame);
}

void check_twos(const RotoscopeFilmOptions& options) {
  if (!options.on_twos) return;
  if (options.shots.empty()) throw Error(ErrorKind::wrong_usage, "on twos: has no shots, expected those of the film");
  if (options.frames_between_checkpoints % 2 != 0)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("checkpoint: is {}, expected an even number, because each painting is shown twice",
                            options.frames_between_checkpoints));
}

/// "painting frame 12 of 240, 2.10 a second".
std::string step_text(std::int64_t frame, std::int64_t expected, std::int64_t done_before, double seconds) {
  const auto painted = static_cast<double>(frame - done_before);
  std::string text =
      expected > 0 ? fmt::format("painting frame {} of {}", frame, expected) : fmt::format("painting frame {}", frame);
  if (painted >= 1 && seconds > 0) text += fmt::format(", {:.2f} a second", painted / seconds);
  return text;
}

void add(const RotoscopeTimes& times, const PaintingTimes& painting, RotoscopedFilm& film) {
  film.times.matching_s += times.matching_s;
  film.times.central_s += times.central_s;
  film.times.flow_s += times.flow_s;
  film.painting_times.planning_s += painting.planning_s;
  film.painting_times.rasterising_s += painting.rasterising_s;
}

void add(const PlannedFilmFrame& frame, RotoscopedFilm& film) { add(frame.times, frame.painting_times, film); }

std::string note_of(std::int64_t frame, const std::string& rows_note) {
  return fmt::format("from frame {} on, {}", frame, rows_note);
}

RotoscopedFilm paint_frames(StereoFilmReader& source, FilmOutput& output, const RotoscopeFilmOptions& options,
                            const Progress& progress, FilmState& state) {
  RotoscopedFilm film;
  film.resumed_frames = source.skip(output.frames_done());
  if (film.resumed_frames > 0) report(progress, "resuming", 0);
  const std::int64_t expected = options.expected_frames;
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processor_seconds();
  film.frames = film.resumed_frames;
  PaintedFilmFrame shown;
  for (StereoFrame frame; source.read(frame); ++film.frames) {
    const std::string text = step_text(film.frames, expected, film.resumed_frames, seconds_since(start));
    const double share =
        expected > 0 ? std::min(static_cast<double>(film.frames) / static_cast<double>(expected), 1.0) : 0;
    // The steps within a frame are asked only whether to go on.
    const Progress within = [&](std::string_view, double) { report(progress, text, share); };
    within("", 0);
    if (is_repeated(options, state.shot.frames)) {
      repeat_film_frame(shown, state);
    } else {
      shown = paint_film_frame(frame, options, !output.is_plan(), state, within);
      add(shown.shot, film);
      if (shown.outgoing) add(*shown.outgoing, film);
      if (!shown.shot.rows_note.empty()) film.notes.push_back(note_of(film.frames, shown.shot.rows_note));
    }
    output.write_marks(shown, frame, state);
    if (!output.is_plan()) output.write(frame_at(shown.frame, frame), state);
  }
  if (film.frames == 0) throw Error(ErrorKind::wrong_usage, "the film has no frame in the requested time range");
  film.totals = state.shot.totals;
  film.seconds = seconds_since(start);
  film.core_seconds = processor_seconds() - processor_start;
  return film;
}

/// The totals of the frames of two parts of a film.
RotoscopeTotals together(const RotoscopeTotals& a, const RotoscopeTotals& b) {
  static_assert(field_count<RotoscopeTotals>() == 8);
  return {.scenes = a.scenes + b.scenes,
          .whole_strokes = a.whole_strokes + b.whole_strokes,
          .survived_strokes = a.survived_strokes + b.survived_strokes,
          .popped_strokes = a.popped_strokes + b.popped_strokes,
          .strokes = a.strokes + b.strokes,
          .worst_bare_share = std::max(a.worst_bare_share, b.worst_bare_share),
          .moved_frames = a.moved_frames + b.moved_frames,
          .least_separation = std::min(a.least_separation, b.least_separation)};
}

/// The work of ranks on one film: each paints whole scenes and passes the frames to the first, which paints as well,
/// and writes them in order as they come.
class SharedWork {
 public:
  /// `output` is at the first of the ranks only.
  SharedWork(StereoFilmReader& source, FilmOutput* output, const fs::path& path, const RotoscopeFilmOptions& options,
             const Progress& progress)
      : source_(source),
        output_(output),
        path_(path),
        options_(options),
        progress_(progress),
        // Nobody looks into the folder before the first has made it.
        done_(options.ranks.from_all(output != nullptr ? output->frames_done() : 0).front()),
        parts_(deal_out_scenes(options.scenes, done_, options.ranks.count())),
        passed_(work_folder_of(path), output != nullptr) {}

  /// At the first rank, `state` is the state after the frames that are done; it becomes the state after the last frame.
  RotoscopedFilm paint(FilmState& state) {
    if (options_.scenes.frames == 0)
      throw Error(ErrorKind::wrong_usage, "the film has no frame in the requested time range");
    const double processor_start = processor_seconds();
    before_ = state.shot.totals;
    for (const ScenePart& part : parts_)
      if (part.rank == options_.ranks.rank()) paint_part(part, state);
    // Until the last rank has painted its last frame.
    while (anywhere(false, options_.ranks)) write_what_came(state);
    write_what_came(state);
    if (output_ != nullptr) read_to_the_end();
    film_.frames = options_.scenes.frames;
    film_.resumed_frames = done_;
    film_.totals = state.shot.totals;
    film_.seconds = seconds_since(start_);
    film_.core_seconds = processor_seconds() - processor_start;
    add_up_times();
    return std::move(film_);
  }

 private:
  void paint_part(const ScenePart& part, FilmState& written) {
    read_ += source_.skip(part.begin - read_);
    FilmState state;
    const bool goes_on = part.begin == done_ && !std::ranges::binary_search(options_.scenes.begins, done_);
    if (goes_on) state = read_film_state(state_file(path_, done_));
    state.shot.frames = part.begin;
    state.shot.totals = {};
    PaintedFilmFrame shown;
    for (StereoFrame frame; read_ < part.end; ++read_) {
      if (!source_.read(frame))
        throw Error(ErrorKind::bad_input, fmt::format("the film ended after {} frames, expected {} as at first", read_,
                                                      options_.scenes.frames));
      const Progress within = [&](std::string_view, double) { tell(written.shot.frames); };
      within("", 0);
      std::string note;
      if (is_repeated(options_, state.shot.frames)) {
        repeat_film_frame(shown, state);
      } else {
        shown = paint_film_frame(frame, options_, true, state, within);
        add(shown.shot, film_);
        if (shown.outgoing) add(*shown.outgoing, film_);
        note = shown.shot.rows_note;
      }
      pass(shown, frame, note, state);
      write_what_came(written);
      meet_now_and_then();
    }
  }

  void pass(const PaintedFilmFrame& painted, const StereoFrame& frame, const std::string& note,
            const FilmState& state) {
    const std::int64_t number = state.shot.frames;
    if (const fs::path marks = marks_of(path_, options_); !marks.empty())
      write_painting(unfinished_marks(marks, number), painted.shot.painting);
    PassedFrame passed{frame_at(painted.frame, frame), state.shot.totals, note};
    if (!makes_film()) passed.frame.picture = {}, passed.frame.deep = {};
    if (has_state(number)) write_film_state(passed_.state_file(number), state);
    passed_.put(number, passed);
  }

  /// At the first of the ranks: brings the film as far as frames have come.
  void write_what_came(FilmState& state) {
    if (output_ == nullptr) return;
    while (const std::optional<PassedFrame> passed = passed_.take(state.shot.frames + 1)) {
      const std::int64_t number = state.shot.frames + 1;
      if (number > parts_[part_].end) {
        before_ = state.shot.totals;
        ++part_;
      }
      if (has_state(number)) {
        state = read_film_state(passed_.state_file(number));
        remove_film_state(passed_.state_file(number));
      }
      state.shot.frames = number;
      state.shot.totals = together(before_, passed->totals);
      if (!passed->rows_note.empty()) film_.notes.push_back(note_of(number - 1, passed->rows_note));
      output_->write(passed->frame, state);
      tell(number);
    }
  }

  /// Learns whether another rank has failed: not after every frame, since ranks wait for each other.
  void meet_now_and_then() {
    constexpr double seconds_between = 10;
    if (seconds_since(met_) < seconds_between) return;
    anywhere(true, options_.ranks);
    met_ = std::chrono::steady_clock::now();
  }

  void tell(std::int64_t written) const {
    const std::int64_t all = options_.scenes.frames;
    report(progress_, step_text(written, all, done_, seconds_since(start_)),
           static_cast<double>(written) / static_cast<double>(all));
  }

  /// The source reports missing frames only when it was read to its end.
  void read_to_the_end() {
    read_ += source_.skip(options_.scenes.frames - read_);
    StereoFrame none;
    source_.read(none);
  }

  void add_up_times() {
    struct Times {
      double core_s;
      RotoscopeTimes times;
      PaintingTimes painting;
    };
    const Times mine{film_.core_seconds, film_.times, film_.painting_times};
    film_.core_seconds = 0;
    film_.times = {};
    film_.painting_times = {};
    for (const Times& of_rank : options_.ranks.from_all(mine)) {
      film_.core_seconds += of_rank.core_s;
      add(of_rank.times, of_rank.painting, film_);
    }
  }

  bool makes_film() const { return path_.extension() != ".wst"; }
  /// Whether the film can be gone on with after so many frames.
  bool has_state(std::int64_t frames) const {
    return makes_film() && (frames % options_.frames_between_checkpoints == 0 || frames == options_.scenes.frames);
  }

  StereoFilmReader& source_;
  FilmOutput* output_;
  const fs::path& path_;
  const RotoscopeFilmOptions& options_;
  const Progress& progress_;
  std::int64_t done_;  ///< frames that an earlier run has left
  std::vector<ScenePart> parts_;
  PassedFrames passed_;
  RotoscopedFilm film_;
  std::int64_t read_ = 0;   ///< frames of the source
  std::size_t part_ = 0;    ///< that is being written
  RotoscopeTotals before_;  ///< of all parts before it
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), met_ = start_;
};

/// Keeps the finished part of a film that an error stopped, if it can be resumed. Throws the error, or UnfinishedFilm.
[[noreturn]] void leave(const Error& error, bool painted, FilmOutput& out, const fs::path& output,
                        const fs::path& marks) {
  const bool can_go_on =
      painted || error.kind() == ErrorKind::interrupted || error.kind() == ErrorKind::cannot_read_write;
  const std::int64_t kept = out.frames_done();
  if (!can_go_on || kept == 0) out.discard();
  if (error.kind() == ErrorKind::interrupted && kept > 0)
    throw UnfinishedFilm(ErrorKind::interrupted,
                         fmt::format("interrupted; {}", unfinished_film(output, marks).value_or("nothing is kept")));
  throw error;
}

/// The error that all ranks end with if one of them throws. Afterwards no rank paints.
Error agreed(const Error& error, const Ranks& ranks) {
  const Ranks::Failure failure = ranks.fail({static_cast<int>(error.kind()), error.what()});
  return {static_cast<ErrorKind>(failure.exit_code), failure.message};
}

}  // namespace

std::string recipe_of(const RotoscopeFilmOptions& options) {
  // Whoever adds a member says here whether it decides a byte. Not in the text: `writing` and the interval, which the
  // film's segments compare themselves, the sources, which are compared by what is in them, and what only says how
  // the run goes: plan, version, resume, keep_going, expected_frames, ranks and their scenes.
  static_assert(field_count<RotoscopeFilmOptions>() == 20);
  RotoscopeOptions frames = options.frames;
  frames.matching.model.clear();  // their content is compared
  frames.flow_model.clear();
  FilmReaderOptions reading = options.reading;
  reading.threads = 0;  // the same frames on any number
  return fmt::format("{}\n{}\n{}\n{}\nanaglyph {}\ntwo films {}\nmarks {}\nknown {}\nmask {}\ntwos {}", options.made_by,
                     text_of_fields(frames), text_of_fields(options.shots), text_of_fields(reading), options.anaglyph,
                     !options.right_film.empty(), options.marks.string(), static_cast<bool>(options.known),
                     static_cast<bool>(options.mask), options.on_twos);
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
  check_twos(options);
  std::optional<FilmOutput> out;
  if (options.ranks.first()) out.emplace(output, options);
  // A damaged state is reported but not removed: the user decides.
  FilmState state = out ? out->state() : FilmState();
  RotoscopedFilm film;
  bool painted = false;
  try {
    film = options.ranks.alone() ? paint_frames(source, *out, options, progress, state)
                                 : SharedWork(source, out ? &*out : nullptr, output, options, progress).paint(state);
    painted = true;
    if (!out) return film;
    for (std::string& note : out->finish(state, progress)) film.notes.push_back(std::move(note));
  } catch (const Error& thrown) {
    const Error error = agreed(thrown, options.ranks);
    if (!out) throw error;
    if (!options.ranks.alone()) remove_passed_frames(work_folder_of(output));
    leave(error, painted, *out, output, options.marks);
  } catch (...) {
    // Exceptions other than Error, such as a lack of memory, leave no empty folder, either.
    if (out && out->frames_done() == 0) out->discard();
    throw;
  }
  for (std::string& note : notes_on_reading(source.facts())) film.notes.push_back(std::move(note));
  film.loss = source.loss();
  if (film.loss && !options.keep_going) {
    const bool is_plan = !options.plan.empty();
    throw Error(ErrorKind::bad_input,
                fmt::format("{}; the {} frames that could be decoded were {} to {}", *film.loss, film.frames,
                            is_plan ? "planned" : "painted", (is_plan ? options.plan : output).string()));
  }
  return film;
}

}  // namespace wheatstone
