#include "wheatstone/app/film_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <system_error>
#include <utility>

#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/film_plan_file_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

std::int64_t count_of_frames(const FilmPlan& plan) { return static_cast<std::int64_t>(plan.frames.size()); }

std::int64_t count_of_segments(const FilmPlan& plan) {
  return (count_of_frames(plan) + plan.frames_per_segment - 1) / plan.frames_per_segment;
}

/// The frames of a segment, which is counted from 0.
FrameRange frames_of(const FilmPlan& plan, std::int64_t segment) {
  const std::int64_t before = segment * plan.frames_per_segment;
  return {before + 1, std::min(before + plan.frames_per_segment, count_of_frames(plan))};
}

/// A film that is made of a plan, and where its segments are.
struct FilmOfPlan {
  fs::path film, parts;
};

std::vector<FilmOfPlan> films_of(const fs::path& folder, const FilmPlan& plan) {
  std::vector<FilmOfPlan> films{{plan.film, folder / "parts"}};
  if (!plan.right_film.empty()) films.push_back({plan.right_film, folder / "parts_right"});
  return films;
}

bool is_drawn(const std::vector<FilmOfPlan>& films, const FilmPlan& plan, std::int64_t segment) {
  const FrameRange frames = frames_of(plan, segment);
  return std::ranges::all_of(films, [&](const FilmOfPlan& film) {
    return frames_of_segment(film.parts, segment) == frames.last - frames.first + 1;
  });
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write: {}", folder.string(), error.message()));
}

/// Throws where a segment is missing, with the frames up to the next one that is there.
void check_drawn(const fs::path& folder, const FilmPlan& plan) {
  const std::vector<FilmOfPlan> films = films_of(folder, plan);
  std::int64_t first = 0;
  while (first < count_of_segments(plan) && is_drawn(films, plan, first)) ++first;
  if (first == count_of_segments(plan)) return;
  std::int64_t end = first + 1;
  while (end < count_of_segments(plan) && !is_drawn(films, plan, end)) ++end;
  const std::int64_t from = frames_of(plan, first).first, to = frames_of(plan, end - 1).last;
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: frames {} to {} are not drawn, expected all {}; draw them with --draw --frame-range "
                          "{}-{}",
                          folder.string(), from, to, count_of_frames(plan), from, to));
}

}  // namespace

FrameRange frames_of_part(const FilmPlan& plan, std::int64_t number, std::int64_t parts) {
  const std::int64_t segments = count_of_segments(plan), step = plan.frames_per_segment;
  return {segments * (number - 1) / parts * step + 1,
          std::min(segments * number / parts * step, count_of_frames(plan))};
}

DrawnPart draw_film_part(const fs::path& folder, const FilmPlan& plan, FrameRange range, const Progress& progress) {
  if (range.first < 1 || range.last < range.first || range.last > count_of_frames(plan))
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: has the frames 1 to {}, not {} to {}", folder.string(),
                                                    count_of_frames(plan), range.first, range.last));
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  const std::vector<FilmOfPlan> films = films_of(folder, plan);
  for (const FilmOfPlan& film : films) make_folder(film.parts);
  const StereoLayout layout = films.size() == 1 ? plan.writing.layout : StereoLayout::left_right;
  DrawnPart part;
  const std::int64_t step = plan.frames_per_segment;
  for (std::int64_t segment = (range.first + step - 2) / step; segment * step < range.last; ++segment) {
    const FrameRange frames = frames_of(plan, segment);
    if (is_drawn(films, plan, segment)) {
      part.drawn_before += frames.last - frames.first + 1;
      continue;
    }
    std::vector<FilmSegment> files;
    for (const FilmOfPlan& film : films) files.emplace_back(film.parts, segment, film.film, plan.writing);
    for (std::int64_t number = frames.first; number <= frames.last; ++number) {
      report(progress, fmt::format("drawing frame {} of {} to {}", number, range.first, range.last),
             static_cast<double>(number - range.first) / static_cast<double>(range.last - range.first + 1));
      const FrameInPlan& shown = plan.frames[static_cast<std::size_t>(number - 1)];
      const auto draw = [&](const FrameOfPlan& planned) {
        DrawnFrame drawn = draw_film_frame(planned.painting, planned.showing);
        part.worst_bare_share = std::max(part.worst_bare_share, drawn.worst_bare_share);
        return frame_in_film(std::move(drawn), layout, plan.anaglyph);
      };
      Frame frame = draw(read_planned_frame(folder, plan, number));
      if (shown.outgoing) dissolve_from(draw(read_outgoing_frame(folder, plan, number)), shown.share, frame);
      frame.pts = shown.pts;
      frame.time_base = shown.time_base;
      frame.duration = shown.duration;
      const std::vector<Frame> of_films = frames_of_films(std::move(frame), films.size());
      for (std::size_t i = 0; i < files.size(); ++i) files[i].write(of_films[i]);
      ++part.frames;
    }
    for (FilmSegment& file : files) file.finish();
  }
  part.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  part.core_seconds = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  return part;
}

std::vector<std::string> join_film_parts(const fs::path& folder, const FilmPlan& plan, const Progress& progress) {
  check_drawn(folder, plan);
  std::vector<SegmentedFilm> films;
  try {
    for (const FilmOfPlan& of_plan : films_of(folder, plan)) {
      SegmentOptions segments{plan.frames_per_segment, "parts of a plan", {}, false};
      films.emplace_back(of_plan.film, plan.writing, segments);
      films.back().take_segments(of_plan.parts);
    }
    // The films of both eyes get their names together.
    const auto hold = hold_outputs();
    for (SegmentedFilm& film : films) film.finish(&film == &films.front() ? progress : Progress());
  } catch (...) {
    // A film that another run is making, or has left, is not in `films`.
    for (SegmentedFilm& film : films) film.discard();
    throw;
  }
  return films.front().notes();
}

}  // namespace wheatstone
