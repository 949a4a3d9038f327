#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <system_error>
#include <utility>

#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/film_output_internal.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

bool has_only_marks(const fs::path& output) { return output.extension() == ".wst"; }

/// The files that decide the film's bytes, including networks.
std::vector<fs::path> sources_of(const RotoscopeFilmOptions& options) {
  std::vector<fs::path> sources = options.made_from;
  for (const fs::path& network : {options.frames.matching.model, options.frames.flow_model})
    if (!network.empty()) sources.push_back(network);
  return sources;
}

void check_marks(const fs::path& path) {
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

}  // namespace

fs::path marks_of(const fs::path& output, const RotoscopeFilmOptions& options) {
  return has_only_marks(output) ? output : options.marks;
}

fs::path state_file(const fs::path& output, std::int64_t frames) {
  return work_folder_of(output) / fmt::format("state_{:09}", frames);
}

FilmOutput::FilmOutput(const fs::path& path, const RotoscopeFilmOptions& options) : path_(path), options_(options) {
  const bool only_marks = has_only_marks(path);
  if (only_marks && options.resume)
    throw Error(ErrorKind::wrong_usage, "a run that writes only marks cannot be resumed: write a film too");
  if (!options.plan.empty()) {
    if (only_marks || options.resume || !options.marks.empty())
      throw Error(ErrorKind::wrong_usage, "a plan is that of a film from its first frame on, and holds its marks");
    check_films();
    plan_.emplace(options.plan);
    return;
  }
  const fs::path marks = marks_of(path, options);
  if (!marks.empty()) check_marks(marks);
  try {
    if (!only_marks) open_film(path);
    if (!only_marks && !options.right_film.empty()) open_film(options.right_film);
    if (!marks.empty()) marks_.emplace(marks, frames_done());
  } catch (const Error&) {
    // Where nothing was painted yet, a failure leaves nothing.
    for (SegmentedFilm& film : films_)
      if (film.frames_done() == 0) film.discard();
    throw;
  }
}

/// What cannot be made of a plan is refused before it is planned.
void FilmOutput::check_films() {
  open_film(path_);
  if (!options_.right_film.empty()) open_film(options_.right_film);
  discard();
  films_.clear();
}

void FilmOutput::open_film(const fs::path& path) {
  films_.emplace_back(
      path, options_.writing,
      SegmentOptions{options_.frames_between_checkpoints, recipe_of(options_), sources_of(options_), options_.resume});
  kept_.push_back(films_.back().frames_done());
}

std::int64_t FilmOutput::frames_done() const {
  std::int64_t least = films_.empty() ? 0 : films_.front().frames_done();
  for (const SegmentedFilm& film : films_) least = std::min(least, film.frames_done());
  return least;
}

FilmState FilmOutput::state() const {
  return frames_done() > 0 ? read_film_state(state_file(path_, frames_done())) : FilmState();
}

void FilmOutput::write_marks(const PaintedFilmFrame& frame, const StereoFrame& times, const FilmState& state) {
  if (plan_) plan_->write(frame, times);
  if (marks_) marks_->write(state.shot.frames, frame.shot.painting);
}

void FilmOutput::write(Frame frame, const FilmState& state) {
  if (films_.empty()) return;
  const int interval = options_.frames_between_checkpoints;
  const std::int64_t number = state.shot.frames;
  const bool at_checkpoint = number % interval == 0;
  // Before the segment of these frames is closed: each closed segment has its state.
  if (at_checkpoint) write_film_state(state_file(path_, number), state);
  // The film's frames and their marks are kept together.
  std::unique_lock<std::recursive_mutex> hold;
  if (at_checkpoint) hold = hold_outputs();
  const std::vector<Frame> frames = frames_of_films(std::move(frame), films_.size());
  // A run may have been killed when one film had closed a segment and the other had not yet.
  for (std::size_t i = 0; i < films_.size(); ++i)
    if (number > kept_[i]) films_[i].write(frames[i]);
  if (!at_checkpoint) return;
  if (marks_) marks_->keep();
  remove_film_state(state_file(path_, number - interval));
}

std::vector<std::string> FilmOutput::finish(const FilmState& state, const Progress& progress) {
  // The film and its marks get their names together: no signal may end the program in between.
  const auto hold = hold_outputs();
  if (plan_) finish_plan(state.shot);
  if (!films_.empty()) finish_films(state, progress);
  if (marks_) marks_->give_names(state.shot.frames);
  return films_.empty() ? std::vector<std::string>() : films_.front().notes();
}

void FilmOutput::finish_films(const FilmState& state, const Progress& progress) {
  // Joining closes the last segment, and may be stopped, too.
  const std::int64_t frames = state.shot.frames;
  if (frames > frames_done()) write_film_state(state_file(path_, frames), state);
  if (marks_) marks_->check(frames);
  const std::string comment = moved_eyes_note(state.shot.totals.moved_frames, state.shot.totals.least_separation);
  for (SegmentedFilm& film : films_) {
    if (!comment.empty()) film.set_comment(comment);
    // Stopped between two films, the run would leave one of them.
    film.finish(&film == &films_.front() ? progress : Progress());
  }
}

void FilmOutput::finish_plan(const RotoscopeState& state) {
  FilmPlan plan{.version = options_.version,
                .film = path_,
                .right_film = options_.right_film,
                .writing = options_.writing,
                .anaglyph = options_.anaglyph,
                .frames_per_segment = options_.frames_between_checkpoints,
                .frames = {}};
  // Whoever joins the film may do so from another folder.
  fs::path& source = plan.writing.side_streams_from;
  if (!source.empty()) source = fs::absolute(source);
  const std::string comment = moved_eyes_note(state.totals.moved_frames, state.totals.least_separation);
  if (!comment.empty()) plan.writing.comment = comment;
  plan_->finish(std::move(plan));
}

void FilmOutput::discard() {
  if (marks_) marks_->discard();
  for (SegmentedFilm& film : films_) film.discard();
  plan_.reset();
}

}  // namespace wheatstone
