#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "content.h"
#include "film_player.h"
#include "inputs.h"
#include "jobs.h"
#include "painting.h"
#include "session.h"
#include "stage.h"
#include "wheatstone/error.h"
#include "wheatstone/progress.h"

namespace wheatstone::viewer {

/// A session and the threads that work for it. All functions are for the thread that owns it; none of them blocks, but
/// for `wait`.
class Viewer {
 public:
  /// `wake` is called on any thread when `collect` has something to do.
  explicit Viewer(std::function<void()> wake = {});
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  const Session& session() const { return session_; }
  /// For the commands: what they change is drawn by the next `collect`.
  Session& session() { return session_; }

  /// Makes an item of each of the files, or one of two that are the eyes of one photograph, and opens the first.
  void open_all(const std::vector<std::filesystem::path>& files);
  /// Looks for the other eye's picture beside what is open, a picture of one view, and opens both.
  void open_other_eye();
  /// Makes the built-in still life where it is not made yet, and opens it.
  void open_example();
  /// Opens the item of that number.
  void open(std::size_t item);
  /// Opens an item, and walks its folder.
  void open_files(Item item);
  /// Opens the first of the photographs and paintings in a folder, or the film whose frames it holds.
  void open_folder(const std::filesystem::path& folder);
  /// Opens what comes so many later in the walk, or earlier where negative.
  void step_file(int by);
  /// Paints what is open with the session's style, where there is a photograph.
  void paint();
  /// Touches the painting that is open with a brush, and paints what that changes.
  void touch(const Touch& touch);
  /// Brings the scene's depth within what is comfortable, with the nearest point on the screen plane.
  void show_comfortably();
  /// The player of the film that is open; none where no film is.
  FilmPlayer* film() { return player_.get(); }
  /// Begins to play the film, the series of particles or the camera's path, or to pause it.
  void play_film();
  void pause_film();
  /// Pauses, and shows the frame so many frames later; earlier where negative.
  void step_film(int frames);
  void seek_film(double seconds);
  /// Looks at particles along the path, which begins where it has any keys.
  void take_camera_path(CameraPath path, std::filesystem::path file = {});
  /// Paints the frame that stands, where films are to be painted; shows the frame as it is otherwise.
  void show_standing_frame();
  /// Paints the whole film that is open into a file, beside everything else. Throws Error{wrong_usage} where no film is
  /// open, or one is being painted.
  void paint_whole_film(const std::filesystem::path& output);
  void cancel_whole_film();

  /// The place in which frames are shown.
  void set_viewport(const Viewport& viewport);
  const Viewport& viewport() const { return viewport_; }

  /// Takes over what threads have finished, moves on what moves by itself, and has drawn what has changed. To be called
  /// after every command and when woken, and at `next_step_s` where there is one.
  void collect();
  /// Seconds after which `collect` is to be called, though nothing wakes it.
  std::optional<double> next_step_s() const;

  /// The newest frame; none before the first.
  const Frame* frame() const { return frame_ ? &*frame_ : nullptr; }
  /// Counts frames.
  std::uint64_t frames_drawn() const { return frames_drawn_; }
  /// Something is being opened, painted, moved or drawn.
  bool is_busy() const;
  /// Collects until nothing is busy. For scripts without a window.
  void wait();
  /// Has a file written beside all else, files one after the other, and then does what is to follow. What fails is
  /// told.
  void save(const std::filesystem::path& path, std::function<void()> write, std::function<void()> then = {});
  bool is_saving() const { return files_to_save_ > 0; }
  /// What a file failed with that was to be saved, once.
  std::optional<Error> take_failed_save() { return std::exchange(failed_save_, std::nullopt); }
  /// Returns when all files are written.
  void finish_saving() { saving_.finish(); }
  void finish_saving(std::chrono::milliseconds most) { saving_.finish(most); }
  /// Asks the threads to leave what they do.
  void stop();
  /// A thread does something.
  bool is_working() const;

  Inputs& inputs() { return inputs_; }

  /// Says something to the user.
  void tell(std::string message, bool is_error = false);

 private:
  void move_on();
  /// Finds what the folder of an item holds, on the thread that opens it.
  void find_walk(std::uint64_t job, const Item& item);
  void move_slideshow(double now_s);
  /// Reads what comes next in the folder, where nothing else is being done.
  void read_ahead();
  /// What was read ahead of this item, where its files have not changed since.
  std::optional<Opened> take_ahead(const Item& item);
  void take_film(const std::shared_ptr<const OpenedFilm>& film);
  void move_film(double now_s);
  void take_particles();
  void move_particles(double passed_s);
  void show_particles_at(double seconds);
  /// Has the particles read that the state wants, where others are open and none are being read.
  void read_wanted_particles();
  void read_particles_for(const ParticleChoice& choice, double time);
  void post_particles_failure(const Error& error, double time, std::uint64_t job);
  void draw_if_changed();
  struct Asked;
  /// Draws what was asked for on the drawing thread, quickly at first where that is not all.
  void draw(const Asked& asked, const std::stop_token& stop);
  void post_frame(Frame frame, const Asked& asked);
  ShowFirst showing(std::uint64_t job);
  void take_opened(Opened opened);
  void forget_touches();
  /// Shows what was opened in the mode of its kind.
  void take_usual_mode();
  /// Tells where depth that a hand has changed is more than is comfortable.
  void warn_of_depth();
  /// Paints what is open. What a touch changes is shown first: until that can be seen, all that is to be painted waits.
  void start_painting(bool was_touched);
  /// Gives a painting that has no photograph the strokes of the hand.
  void retouch_what_was_read(PaintedContent& content) const;
  void take_painted(const PaintedContent& content, const std::optional<DepthEnds>& depth);

  Progress progress_of(std::uint64_t job, const std::stop_token& stop);
  void post_failure(const std::exception& error, std::uint64_t job);

  Session session_;
  Inputs inputs_;
  Viewport viewport_{640, 480};
  std::optional<Frame> frame_;
  std::uint64_t frames_drawn_ = 0;

  struct Asked {
    Content content;
    ViewState state;
    Viewport viewport;
  };
  std::optional<Asked> asked_;  ///< for the newest frame that was asked for
  std::uint64_t job_ = 0;       ///< number of the newest opening or painting; what older ones deliver is left aside
  std::optional<std::uint64_t> following_job_;  ///< the painting that a touch started, until it delivers something
  bool paints_anew_ = false;                    ///< after that delivery: more was touched or chosen meanwhile
  double moved_at_s_ = 0, wiggled_at_s_ = 0;
  bool reads_particles_ = false;
  struct Ahead {
    std::vector<std::filesystem::file_time_type> times;
    Opened opened;
  };
  Item ahead_asked_;                   ///< what is read ahead, or was; empty: nothing
  std::optional<Ahead> ahead_;         ///< of that
  double shown_at_s_ = 0;              ///< when a slide began to be shown
  std::optional<double> failed_time_;  ///< of a series, at which it could not be read

  StrokeFits fits_;  ///< of the thread that paints
  Stage stage_;      ///< of the drawing thread
  int files_to_save_ = 0;
  std::optional<Error> failed_save_;

  Mailbox mailbox_;
  OrderedJobs saving_;
  NewestJob making_, drawing_, reading_ahead_;  ///< these and what follows: they end first
  std::unique_ptr<FilmPlayer> player_;
  std::unique_ptr<FilmPainting> whole_film_;
};

}  // namespace wheatstone::viewer
