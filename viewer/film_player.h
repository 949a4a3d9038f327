#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "content.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::viewer {

/// A film that can be played, and what is known of it.
struct FilmToPlay {
  FilmFiles files;  ///< with the layout, where it is one film
  FilmFacts facts;
  std::optional<QuiltLayout> quilt;           ///< of a film of quilts
  std::vector<std::filesystem::path> slices;  ///< of a film of slices: a file for each frame
};

/// A moment of a film, as it is shown. Counted from 0.
struct FilmMoment {
  Content content;
  std::int64_t frame = 0;
  double seconds = 0;
};

/// Looks into a film: its layout and first frame. Throws as open_film.
struct OpenedFilm {
  FilmToPlay film;
  FilmMoment first;
  std::string layout_how;  ///< for people
};
OpenedFilm open_film_to_play(const FilmFiles& files);

/// The same of numbered files of slices, "s_%04d.exr", at 24 frames a second. None where the path is no such pattern,
/// or its first file holds no slices. Throws Error{bad_input} where a number between them is missing.
std::optional<OpenedFilm> open_slices_to_play(const std::filesystem::path& pattern);

/// How long a frame is shown, in seconds, and the whole film; 0 where it is not known.
double seconds_a_frame(const FilmToPlay& film);

/// Plays a film: decodes a few frames ahead on a thread of its own, in memory that does not grow. All functions are for
/// the thread that owns it; none of them blocks, but for the destructor, which waits for a frame being decoded.
/// Times `now_s` are of one steady clock, in seconds.
class FilmPlayer {
 public:
  /// `wake` is called on the decoding thread when a frame that is waited for has come, or decoding has failed. The
  /// first moment is taken as shown.
  FilmPlayer(FilmToPlay film, FilmMoment first, std::function<void()> wake);
  ~FilmPlayer();
  FilmPlayer(const FilmPlayer&) = delete;
  FilmPlayer& operator=(const FilmPlayer&) = delete;

  const FilmToPlay& film() const { return film_; }
  bool plays() const { return plays_; }
  /// A moment is waited for, but for the next one of a film that plays.
  bool is_seeking() const { return seeks_ || steps_ > 0; }

  /// Goes on from what is shown; at the end, from the beginning.
  void play(double now_s);
  void pause();
  /// Pauses, and shows the frame so many frames later; earlier where negative.
  void step(int frames);
  /// Shows the frame nearest to this time.
  void seek(double seconds);

  /// The moment that is to be shown from now on; none where it is the one that is shown. Throws Error where decoding
  /// has failed, once.
  std::unique_ptr<FilmMoment> due(double now_s);
  /// Seconds until the next moment is due; none where nothing plays.
  std::optional<double> next_s(double now_s) const;

 private:
  void decode(const std::stop_token& stop);
  void read_from(double seconds, std::uint64_t search, const std::stop_token& stop);
  void read_slices_from(double seconds, std::uint64_t search, const std::stop_token& stop);
  bool give(std::unique_ptr<FilmMoment> moment, std::uint64_t search, const std::stop_token& stop);
  std::unique_ptr<FilmMoment> take_ahead();
  void search(double seconds);

  FilmToPlay film_;
  std::function<void()> wake_;
  std::int64_t shown_frame_ = 0;
  double shown_s_ = 0;
  bool plays_ = false, seeks_ = false;
  int steps_ = 0;
  double clock_now_s_ = 0, clock_film_s_ = 0;  ///< a moment of both clocks

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::unique_ptr<FilmMoment>> ahead_;
  std::uint64_t search_ = 0;  ///< counts searches: what an older one delivers is left aside
  double searched_s_ = 0;
  bool at_end_ = false;
  bool is_waited_for_ = false;
  std::optional<Error> failure_;
  std::jthread thread_;  ///< last: it ends first
};

}  // namespace wheatstone::viewer
