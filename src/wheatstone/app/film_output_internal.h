#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/app/film_plan_file_internal.h"
#include "wheatstone/app/marks_sequence_internal.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone {

/// The pattern of the names of the files of marks; empty where none are written.
std::filesystem::path marks_of(const std::filesystem::path& output, const RotoscopeFilmOptions& options);

/// The state after so many frames of an unfinished film.
std::filesystem::path state_file(const std::filesystem::path& output, std::int64_t frames);

/// Where frames go: a film that is being made, or one for each eye, or only files of marks, or a plan.
class FilmOutput {
 public:
  FilmOutput(const std::filesystem::path& path, const RotoscopeFilmOptions& options);

  /// Frames that are safe: an earlier run has left them, or this one has closed them.
  std::int64_t frames_done() const;

  /// After the frames that are done.
  FilmState state() const;

  bool is_plan() const { return plan_.has_value(); }
  /// Adds the marks of a frame to the plan, or to the files of marks; of `times` only the times count.
  void write_marks(const PaintedFilmFrame& frame, const StereoFrame& times, const FilmState& state);
  void write(Frame frame, const FilmState& state);

  /// Gives everything its name. Returns what the user should know.
  std::vector<std::string> finish(const FilmState& state, const Progress& progress);

  /// Removes what cannot be resumed.
  void discard();

 private:
  void open_film(const std::filesystem::path& path);
  void check_films();
  void finish_films(const FilmState& state, const Progress& progress);
  void finish_plan(const RotoscopeState& state);

  std::filesystem::path path_;
  const RotoscopeFilmOptions& options_;
  std::vector<SegmentedFilm> films_;
  std::vector<std::int64_t> kept_;  ///< frames that an earlier run has left of each
  std::optional<MarksSequence> marks_;
  std::optional<FilmPlanWriter> plan_;
};

}  // namespace wheatstone
