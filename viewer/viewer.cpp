#include "viewer.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "folder_items.h"
#include "inputs.h"
#include "painting.h"
#include "particle_film.h"
#include "screens.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/painting/retouch_strokes.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer {
namespace {

constexpr double step_of_easing_s = 0.02;
constexpr double step_of_wiggle_s = 0.08;

constexpr std::chrono::milliseconds settled_after{120};

/// Whether something is asked to stop within so long.
bool stops_within(const std::stop_token& stop, std::chrono::milliseconds longest) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  stopped.wait_for(lock, stop, longest, [] { return false; });
  return stop.stop_requested();
}

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

const Item* open_item(const Session& session) {
  return session.item < session.items.size() ? &session.items[session.item] : nullptr;
}

Viewer::Viewer(std::function<void()> wake) : mailbox_(std::move(wake)) {}

Viewer::~Viewer() = default;

void Viewer::open_all(const std::vector<std::filesystem::path>& files) {
  const auto open_each = [this, files] {
    open_files({files.front()});
    session_.walk_is_given = true;
    session_.walk.clear();
    for (const std::filesystem::path& file : files) session_.walk.push_back({file});
  };
  if (files.empty()) return;
  if (files.size() == 1 && is_folder(files.front())) return open_folder(files.front());
  if (const std::optional<std::filesystem::path> series = series_of_files(files)) return open_files({*series});
  if (files.size() == 1) return open_files(files);
  if (files.size() != 2) return open_each();
  session_.opening = Activity{"reading", 0};
  const std::uint64_t job = ++job_;
  // Both are read to find out.
  making_.start([this, job, files, open_each](const std::stop_token&) {
    try {
      const bool is_one = are_eyes_of_one(files[0], files[1], showing(job));
      mailbox_.post([this, job, files, open_each, is_one] {
        if (job != job_) return;
        if (!is_one) return open_each();
        Opened shown = std::move(session_.opened);
        open_files(files);
        session_.opened = std::move(shown);  // until it is read again
      });
    } catch (const std::exception& error) {
      post_failure(error, job);
    }
  });
}

void Viewer::open_other_eye() {
  const Item* const item = open_item(session_);
  if (item == nullptr || !has_one_view(session_.opened.content)) return tell("no picture of one view is open", true);
  session_.opening = Activity{"looking for the other view", 0};
  const std::uint64_t job = ++job_;
  making_.start([this, job, picture = std::filesystem::absolute(item->front())](const std::stop_token&) {
    try {
      const std::optional<std::filesystem::path> other = find_other_eye(picture);
      mailbox_.post([this, job, picture, other] {
        if (job != job_) return;
        session_.opening.reset();
        if (!other)
          return tell(fmt::format("no picture beside {} shows the same from another place; open both together",
                                  picture.filename().string()));
        // Left comes before right, L before R, and most take the left picture first.
        session_.items[session_.item] = {std::min(picture, *other), std::max(picture, *other)};
        open(session_.item);
      });
    } catch (const std::exception& error) {
      post_failure(error, job);
    }
  });
}

void Viewer::open_example() {
  session_.opening = Activity{"making the example", 0};
  const std::uint64_t job = ++job_;
  making_.start([this, job](const std::stop_token& stop) {
    try {
      const std::filesystem::path folder = cache_folder() / "example";
      const Item files{folder / "left.png", folder / "right.png"};
      if (!std::filesystem::exists(files[0]) || !std::filesystem::exists(files[1])) {
        std::filesystem::create_directories(folder);
        const SyntheticStill still = make_synthetic_still({}, progress_of(job, stop));
        write_image(files[0], still.pictures.left);
        write_image(files[1], still.pictures.right);
      }
      mailbox_.post([this, job, files] {
        if (job != job_) return;
        open_files(files);
      });
    } catch (const std::exception& error) {
      post_failure(error, job);
    }
  });
}

void Viewer::open_files(Item item) {
  session_.walk.clear();
  session_.walk_is_given = false;
  session_.items.push_back(std::move(item));
  open(session_.items.size() - 1);
}

void Viewer::open(std::size_t item) {
  if (item >= session_.items.size()) return;
  if (!std::holds_alternative<std::monostate>(session_.opened.content)) tell("");  // it was of another file
  session_.item = item;
  session_.opened = {};
  // Its thread may be in the middle of a frame: who opens waits for that, and the window does not.
  const std::shared_ptr<FilmPlayer> before = std::move(player_);
  session_.film.reset();
  session_.zero_parallax_target_px.reset();
  session_.fixation.reset();
  session_.depth_around_target.reset();
  session_.focus_target.reset();
  session_.state.depth_around.reset();
  session_.opening = Activity{"reading", 0};
  const std::uint64_t job = ++job_;
  reads_particles_ = false;
  failed_time_.reset();
  reading_ahead_.stop();
  making_.start([this, job, before, files = session_.items[item], ahead = take_ahead(session_.items[item]),
                 particles = session_.state.look.choice](const std::stop_token& stop) {
    find_walk(job, files);
    try {
      Opened opened = ahead ? *ahead : open_content(files, progress_of(job, stop), showing(job), particles);
      mailbox_.post([this, job, opened = std::move(opened)]() mutable {
        if (job == job_) take_opened(std::move(opened));
      });
    } catch (const std::exception& error) {
      mailbox_.post([this, job] {
        if (job == job_) session_.opened = {};
      });
      post_failure(error, job);
    }
  });
}

ShowFirst Viewer::showing(std::uint64_t job) {
  return [this, job](Opened opened) {
    mailbox_.post([this, job, opened = std::move(opened)]() mutable {
      if (job == job_) take_opened(std::move(opened));
    });
  };
}

void Viewer::paint() { start_painting(false); }

void Viewer::touch(const Touch& touch) {
  session_.state.touches.push_back(touch);
  start_painting(true);
}

void Viewer::start_painting(bool was_touched) {
  auto* const content = std::get_if<PaintedContent>(&session_.opened.content);
  if (content == nullptr || !session_.opened.is_ready) return;
  if (!content->photograph) return retouch_what_was_read(*content);
  if (session_.film && (session_.film->plays || !session_.film->paints)) return;
  paints_anew_ = following_job_ == job_;
  if (paints_anew_) return;
  session_.opening = Activity{"painting", 0};
  const std::uint64_t job = ++job_;
  if (was_touched) following_job_ = job;
  making_.start([this, job, was_touched, open = *content, style = session_.state.style,
                 touches = session_.film ? std::vector<Touch>() : session_.state.touches](const std::stop_token& stop) {
    try {
      bool waits = was_touched;
      paint_in_steps(open, style, touches, fits_, progress_of(job, stop), [&](const PaintedContent& painted) {
        mailbox_.post([this, job, painted, depth = depth_of(painted)] {
          if (job != job_) return;
          take_painted(painted, depth);
          if (std::exchange(following_job_, std::nullopt) == job && paints_anew_) start_painting(true);
        });
        // What a touch changed is drawn first, and the rest is painted once the hand rests.
        if (std::exchange(waits, false)) stops_within(stop, settled_after);
      });
      mailbox_.post([this, job] {
        if (job == job_) session_.opening.reset();
      });
    } catch (const std::exception& error) {
      post_failure(error, job);
    }
  });
}

void Viewer::retouch_what_was_read(PaintedContent& content) const {
  if (!content.as_read && session_.state.touches.empty()) return;
  if (!content.as_read) content.as_read = content.painting;
  auto painting = std::make_shared<Painting>(*content.as_read);
  retouch_strokes(session_.state.touches, *painting);
  content.painting = std::move(painting);
}

Progress Viewer::progress_of(std::uint64_t job, const std::stop_token& stop) {
  return [this, job, stop](std::string_view step, double done) {
    if (stop.stop_requested()) throw Error(ErrorKind::interrupted, "stopped");
    mailbox_.post([this, job, activity = Activity{std::string(step), done}] {
      if (job == job_ && session_.opening) session_.opening = activity;
    });
  };
}

void Viewer::post_failure(const std::exception& error, std::uint64_t job) {
  mailbox_.post([this, job, message = std::string(error.what())] {
    if (job != job_) return;
    session_.opening.reset();
    tell(message, true);
    if (std::exchange(following_job_, std::nullopt) == job && paints_anew_) start_painting(true);
  });
}

void Viewer::take_usual_mode() {
  const Content& content = session_.opened.content;
  const UsualModes& usual = session_.usual_modes;
  session_.state.mode = has_one_view(content) ? "left" : is_scene(content) ? usual.scenes : usual.pictures;
}

void Viewer::forget_touches() {
  session_.retouch.begun_at_px.reset();
  session_.state.touches.clear();
  for (std::vector<ViewState>* const states : {&session_.done, &session_.undone}) {
    for (ViewState& state : *states) state.touches.clear();
    states->erase(std::unique(states->begin(), states->end()), states->end());
  }
}

void Viewer::take_opened(Opened opened) {
  forget_touches();  // they are of what was open
  session_.opened = std::move(opened);
  take_usual_mode();
  forget_brightness(session_.state.look);
  session_.state.orbit.look_at.reset();
  session_.state.adjustment.zero_parallax_px = 0;
  session_.state.adjustment.separation = 1;
  session_.state.share = 0;
  if (!session_.opened.is_ready) return;
  session_.opening.reset();
  for (const std::string& note : session_.opened.notes) tell(note);
  if (has_one_view(session_.opened.content)) tell("one view; find the other? (O)");
  show_comfortably();
  take_film(session_.opened.film);
  take_particles();
  if (session_.film && session_.film->of_particles && !session_.camera_path.keys.empty()) play_film();
  paint();
}

void Viewer::take_painted(const PaintedContent& content, const std::optional<DepthEnds>& depth) {
  const bool depth_was_known = session_.opened.depth.has_value();
  session_.opened.depth = depth;
  auto& open = std::get<PaintedContent>(session_.opened.content);
  open.photograph = content.photograph;
  if (content.painting) {
    open.painting = content.painting;
    open.touches = content.touches;
  }
  const bool is_placed = session_.film && std::exchange(session_.film->is_placed, true);
  if (!depth_was_known && !is_placed) show_comfortably();
  if (!session_.state.touches.empty()) warn_of_depth();
}

void Viewer::warn_of_depth() {
  const std::optional<DepthEnds>& depth = session_.opened.depth;
  const auto width = static_cast<float>(size_of(session_.opened.content).width);
  if (!depth || !session_.state.depth_regions.empty() || width <= 0) return;
  const float share = session_.state.adjustment.separation * (depth->nearest_px - depth->farthest_px) / width;
  const auto as_told = [](float of_width) { return std::round(1000 * of_width); };
  if (as_told(share) > as_told(comfortable_parallax_share))
    tell(fmt::format(
        "the depth is {:.1f} % of the width, more than the {:.0f} % that are comfortable; undo, or lower the "
        "separation",
        100 * share, 100 * comfortable_parallax_share));
}

void Viewer::show_comfortably() {
  const std::optional<DepthEnds>& depth = session_.opened.depth;
  if (!depth) return;
  Adjustment& adjustment = session_.state.adjustment;
  if (!session_.state.depth_regions.empty()) {
    // What has been placed lies as it is to be.
    adjustment.zero_parallax_px = 0;
    adjustment.separation = 1;
    return;
  }
  adjustment.zero_parallax_px = depth->nearest_px;
  const float budget_px = comfortable_parallax_share * static_cast<float>(size_of(session_.opened.content).width);
  adjustment.separation = std::min(1.f, budget_px / std::max(depth->nearest_px - depth->farthest_px, 1e-3f));
}

void Viewer::set_viewport(const Viewport& viewport) { viewport_ = viewport; }

void Viewer::tell(std::string message, bool is_error) {
  session_.message = std::move(message);
  session_.message_is_error = is_error;
}

void Viewer::collect() {
  mailbox_.open();
  move_on();
  const PictureSize eye = eye_size(find_output_mode(session_.state.mode), viewport_);
  session_.eye = eye;
  draw_if_changed();
  read_ahead();
}

void Viewer::move_on() {
  const double now = now_s();
  const double since_s = now - std::exchange(moved_at_s_, now);
  const double passed_s = std::min(since_s, step_of_easing_s * 4);
  move_film(now);
  move_slideshow(now);
  move_particles(since_s);
  if (session_.zero_parallax_target_px) {
    constexpr float near_enough_px = 0.05f;
    float& zero_parallax_px = session_.state.adjustment.zero_parallax_px;
    const float rest = *session_.zero_parallax_target_px - zero_parallax_px;
    zero_parallax_px += rest * static_cast<float>(1 - std::exp(-passed_s / session_.easing_s));
    if (std::abs(*session_.zero_parallax_target_px - zero_parallax_px) < near_enough_px) {
      zero_parallax_px = *session_.zero_parallax_target_px;
      session_.zero_parallax_target_px.reset();
      session_.easing_s = click_easing_s;
    }
  }
  move_gaze_depth(session_, passed_s);
  inputs_.go_on(session_, now);
  if (session_.state.mode == "wiggle" && now - wiggled_at_s_ >= step_of_wiggle_s) {
    ++session_.state.step;
    wiggled_at_s_ = now;
  }
}

std::optional<double> Viewer::next_step_s() const {
  const std::optional<double> film_s = player_ ? player_->next_s(now_s()) : std::nullopt;
  const std::optional<double> input_s = inputs_.next_step_s();
  if (film_s && input_s) return std::min(*film_s, *input_s);
  if (film_s || input_s) return film_s ? film_s : input_s;
  const bool particles_play = session_.film && session_.film->of_particles && session_.film->plays;
  if (session_.zero_parallax_target_px || gaze_depth_moves(session_) || particles_play) return step_of_easing_s;
  if (session_.state.mode == "wiggle") return step_of_wiggle_s;
  if (session_.slideshow_s > 0 && !session_.opening)
    return std::max(shown_at_s_ + session_.slideshow_s - now_s(), step_of_easing_s);
  return {};
}

void Viewer::draw_if_changed() {
  const bool changed = !asked_ || asked_->content != session_.opened.content || asked_->state != session_.state ||
                       asked_->viewport != viewport_;
  if (!changed || viewport_.width < 1 || viewport_.height < 1) return;
  asked_ = Asked{session_.opened.content, session_.state, viewport_};
  drawing_.start([this, asked = *asked_](const std::stop_token& stop) {
    try {
      draw(asked, stop);
    } catch (const std::exception& error) {
      mailbox_.post([this, message = std::string(error.what())] { tell(message, true); });
    }
  });
}

void Viewer::draw(const Asked& asked, const std::stop_token& stop) {
  Frame quick = stage_.draw(asked.content, asked.state, asked.viewport, Effort::quick);
  const bool preliminary = quick.preliminary;
  post_frame(std::move(quick), asked);
  // What moves goes on moving: the rest is worth its while when it stands.
  if (!preliminary || stops_within(stop, settled_after)) return;
  post_frame(stage_.draw(asked.content, asked.state, asked.viewport), asked);
}

void Viewer::post_frame(Frame frame, const Asked& asked) {
  auto shared = std::make_shared<Frame>(std::move(frame));
  mailbox_.post([this, shared, asked] {
    // What the first whole picture found stays, so that nothing flickers.
    if (shared->brightness && !shared->preliminary && asked.content == session_.opened.content &&
        asked.state.look == session_.state.look) {
      keep_brightness(session_.state.look, *shared->brightness);
      if (asked_ && asked_->state == asked.state) asked_->state.look = session_.state.look;
    }
    frame_ = std::move(*shared);
    ++frames_drawn_;
  });
}

bool Viewer::is_busy() const {
  return session_.opening || session_.whole_film || (player_ && player_->is_seeking()) ||
         session_.zero_parallax_target_px || gaze_depth_moves(session_) || is_working() || is_saving() ||
         !mailbox_.is_empty();
}

void Viewer::save(const std::filesystem::path& path, std::function<void()> write, std::function<void()> then) {
  ++files_to_save_;
  saving_.start([this, path, write = std::move(write), then = std::move(then)] {
    std::optional<Error> failed;
    try {
      write();
    } catch (const Error& error) {
      failed = error;
    } catch (const std::exception& error) {
      failed = Error(ErrorKind::cannot_read_write, fmt::format("{}: {}", path.string(), error.what()));
    }
    mailbox_.post([this, path, failed, then] {
      --files_to_save_;
      if (failed) failed_save_ = failed;
      tell(failed ? failed->what() : "saved " + path.string(), failed.has_value());
      if (!failed && then) then();
    });
  });
}

void Viewer::stop() {
  ++job_;
  session_.opening.reset();
  making_.stop();
  drawing_.stop();
  reading_ahead_.stop();
  cancel_whole_film();
}

bool Viewer::is_working() const {
  return making_.is_busy() || drawing_.is_busy() || saving_.is_busy() || (whole_film_ && !whole_film_->has_ended());
}

void Viewer::wait() {
  while (true) {
    collect();
    if (!is_busy()) return;
    constexpr std::chrono::milliseconds step(10);
    // What eases moves on with time alone: each picture that is done would only ask for the next, a moment later.
    if (session_.zero_parallax_target_px || gaze_depth_moves(session_))
      std::this_thread::sleep_for(step);
    else
      mailbox_.wait_for(step);
  }
}

std::string proposed_name(const Session& session, std::string_view command) {
  const Item* const item = open_item(session);
  const std::string stem = item == nullptr ? "picture" : item->front().stem().string();
  if (command == "save-style") return session.state.style.name + ".toml";
  if (command == "save-camera") return "path.toml";
  if (command == "save-painting") return stem + ".wst";
  if (command == "paint-film") return stem + "_painted.mp4";
  if (command == "save-disparity") return stem + "_disparity.png";
  return fmt::format("{}_{}.png", stem, session.state.mode);
}

std::vector<Item> recent_items(std::span<const Item> opened, std::span<const Item> before) {
  constexpr std::size_t most = 10;
  std::vector<Item> recent;
  const auto add = [&](Item item) {
    for (std::filesystem::path& file : item) file = std::filesystem::absolute(file).lexically_normal();
    if (recent.size() < most && std::ranges::find(recent, item) == recent.end()) recent.push_back(std::move(item));
  };
  for (auto item = opened.rbegin(); item != opened.rend(); ++item) add(*item);
  for (const Item& item : before) add(item);
  return recent;
}

}  // namespace wheatstone::viewer
