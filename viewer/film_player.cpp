#include "film_player.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::viewer {
namespace {

constexpr std::size_t frames_ahead = 5;

double frames_a_second(const FilmToPlay& film) {
  double rate = film.facts.frame_rate.value();
  const bool in_time = film.files.layout && traits_of(*film.files.layout).arrangement == Arrangement::in_time;
  if (in_time) rate /= 2;  // a moment is two frames
  return rate > 0 ? rate : 25;
}

Content content_of(StereoFrame& frame, const std::optional<QuiltLayout>& quilt) {
  if (quilt || frame.right.empty()) {
    std::vector<Image<Rgb8>> views;
    if (quilt)
      views = views_of_quilt(frame.left, *quilt);
    else
      views.push_back(std::move(frame.left));
    return ViewsContent{std::make_shared<const std::vector<Image<Rgb8>>>(std::move(views)), quilt ? 1.f : 0.f};
  }
  auto photograph = std::make_shared<Photograph>();
  photograph->pictures = {std::move(frame.left), std::move(frame.right)};
  return PaintedContent{nullptr, std::move(photograph)};
}

std::unique_ptr<FilmMoment> moment_of(StereoFrame& frame, const FilmToPlay& film) {
  const double seconds = static_cast<double>(frame.pts) * frame.time_base.value();
  return std::make_unique<FilmMoment>(
      FilmMoment{content_of(frame, film.quilt), std::llround(seconds * frames_a_second(film)), seconds});
}

/// Reads a frame's file of slices.
std::unique_ptr<FilmMoment> moment_of_slices(const FilmToPlay& film, std::size_t frame) {
  return std::make_unique<FilmMoment>(
      FilmMoment{SlicesContent{std::make_shared<const SliceStack>(read_slices(film.slices[frame]))},
                 static_cast<std::int64_t>(frame), static_cast<double>(frame) * seconds_a_frame(film)});
}

}  // namespace

double seconds_a_frame(const FilmToPlay& film) { return 1 / frames_a_second(film); }

OpenedFilm open_film_to_play(const FilmFiles& files) {
  OpenedFilm opened{.film = {.files = files}};
  if (const auto quilt = quilt_of_name(files.film.filename().string())) {
    opened.film.quilt = quilt->layout;
    opened.film.files.layout = StereoLayout::mono;
  }
  StereoFilmReader reader = open_film(opened.film.files);
  opened.film.facts = reader.facts();
  opened.layout_how = reader.layout_how();
  if (files.right.empty()) opened.film.files.layout = reader.layout();
  StereoFrame frame;
  if (!reader.read(frame)) throw Error(ErrorKind::bad_input, files.film.string() + ": has no frame");
  opened.first = *moment_of(frame, opened.film);
  return opened;
}

std::optional<OpenedFilm> open_slices_to_play(const std::filesystem::path& pattern) {
  const std::optional<FramePattern> names = frame_pattern(pattern);
  if (!names || pattern.extension() != ".exr" || numbers_of(*names).empty()) return {};
  OpenedFilm opened{.film = {.files = {.film = pattern}}};
  for (const std::int64_t number : numbers_without_hole(*names)) opened.film.slices.push_back(names->file(number));
  if (!holds_slices(opened.film.slices.front())) return {};
  FilmFacts& facts = opened.film.facts;
  facts.frame_rate = {24, 1};
  facts.frame_count = static_cast<std::int64_t>(opened.film.slices.size());
  facts.duration_s = static_cast<double>(opened.film.slices.size()) * seconds_a_frame(opened.film);
  opened.first = *moment_of_slices(opened.film, 0);
  return opened;
}

FilmPlayer::FilmPlayer(FilmToPlay film, FilmMoment first, std::function<void()> wake)
    : film_(std::move(film)), wake_(std::move(wake)), shown_frame_(first.frame), shown_s_(first.seconds) {
  searched_s_ = shown_s_ + seconds_a_frame(film_) / 2;
  thread_ = std::jthread([this](const std::stop_token& stop) { decode(stop); });
}

FilmPlayer::~FilmPlayer() = default;

void FilmPlayer::play(double now_s) {
  bool has_ended = false;
  {
    const std::lock_guard lock(mutex_);
    has_ended = at_end_ && ahead_.empty();
  }
  steps_ = 0;
  if (has_ended) seek(0);
  plays_ = true;
  clock_now_s_ = now_s;
  clock_film_s_ = shown_s_;
}

void FilmPlayer::pause() { plays_ = false; }

void FilmPlayer::step(int frames) {
  plays_ = false;
  if (frames > 0) {
    steps_ += frames;
    const std::lock_guard lock(mutex_);
    is_waited_for_ = true;
  } else if (frames < 0) {
    seek(shown_s_ + frames * seconds_a_frame(film_));
  }
}

void FilmPlayer::seek(double seconds) {
  steps_ = 0;
  const double frame_s = seconds_a_frame(film_);
  const double last_s = film_.facts.duration_s > 0 ? film_.facts.duration_s - frame_s : seconds;
  search(std::max(std::min(seconds, last_s), 0.) - frame_s / 2);
  seeks_ = true;
}

void FilmPlayer::search(double seconds) {
  const std::lock_guard lock(mutex_);
  ++search_;
  searched_s_ = seconds;
  ahead_.clear();
  at_end_ = false;
  is_waited_for_ = true;
  changed_.notify_all();
}

std::unique_ptr<FilmMoment> FilmPlayer::take_ahead() {
  const std::lock_guard lock(mutex_);
  if (ahead_.empty()) return {};
  std::unique_ptr<FilmMoment> moment = std::move(ahead_.front());
  ahead_.pop_front();
  is_waited_for_ = false;
  changed_.notify_all();
  return moment;
}

std::unique_ptr<FilmMoment> FilmPlayer::due(double now_s) {
  bool at_end = false;
  double next_s = 0;
  {
    const std::lock_guard lock(mutex_);
    if (failure_) {
      plays_ = seeks_ = false;
      steps_ = 0;
      throw Error(*std::exchange(failure_, std::nullopt));
    }
    if (ahead_.empty()) {
      at_end = at_end_;
      if (plays_ || is_seeking()) is_waited_for_ = !at_end;
    } else {
      next_s = ahead_.front()->seconds;
    }
    if (at_end) {
      plays_ = plays_ && seeks_;
      seeks_ = false;
      steps_ = 0;
    }
    if (ahead_.empty()) return {};
  }
  std::unique_ptr<FilmMoment> moment;
  if (seeks_ || steps_ > 0) {
    const int wanted = std::exchange(seeks_, false) ? 1 : steps_;
    for (int i = 0; i < wanted; ++i) {
      std::unique_ptr<FilmMoment> next = take_ahead();
      if (!next) break;
      moment = std::move(next);
      if (steps_ > 0) --steps_;
    }
    clock_now_s_ = now_s;
    clock_film_s_ = moment->seconds;
  } else if (plays_) {
    const double film_s = clock_film_s_ + now_s - clock_now_s_;
    while (next_s <= film_s) {
      moment = take_ahead();
      const std::lock_guard lock(mutex_);
      if (ahead_.empty()) break;
      next_s = ahead_.front()->seconds;
    }
  }
  if (moment) {
    shown_frame_ = moment->frame;
    shown_s_ = moment->seconds;
  }
  return moment;
}

std::optional<double> FilmPlayer::next_s(double now_s) const {
  if (!plays_) return {};
  const std::lock_guard lock(mutex_);
  if (ahead_.empty()) return seconds_a_frame(film_);
  return std::clamp(ahead_.front()->seconds - (clock_film_s_ + now_s - clock_now_s_), 0.001, 0.1);
}

bool FilmPlayer::give(std::unique_ptr<FilmMoment> moment, std::uint64_t search, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const bool goes_on =
      changed_.wait(lock, stop, [&] { return ahead_.size() < frames_ahead || search_ != search; }) && search_ == search;
  if (!goes_on) return false;
  ahead_.push_back(std::move(moment));
  const bool is_waited_for = is_waited_for_;
  lock.unlock();
  if (is_waited_for) wake_();
  return true;
}

void FilmPlayer::read_from(double seconds, std::uint64_t search, const std::stop_token& stop) {
  FilmReaderOptions options;
  if (seconds > 0) options.from_s = seconds;
  StereoFilmReader reader = open_film(film_.files, options);
  StereoFrame frame;
  bool any = false;
  while (!stop.stop_requested() && reader.read(frame)) {
    any = true;
    if (!give(moment_of(frame, film_), search, stop)) return;
  }
  if (any || stop.stop_requested() || !(seconds > 0)) return;
  // Behind the last frame: that one is shown.
  for (double back_s = 1; !any; back_s *= 4) {
    FilmReaderOptions earlier;
    if (seconds > back_s) earlier.from_s = seconds - back_s;
    StereoFilmReader from_earlier = open_film(film_.files, earlier);
    while (!stop.stop_requested() && from_earlier.read(frame)) any = true;
    if (stop.stop_requested() || !earlier.from_s) break;
  }
  if (any) give(moment_of(frame, film_), search, stop);
}

void FilmPlayer::read_slices_from(double seconds, std::uint64_t search, const std::stop_token& stop) {
  const double from = std::ceil(std::max(seconds, 0.) / seconds_a_frame(film_));
  for (auto frame = static_cast<std::size_t>(from); frame < film_.slices.size() && !stop.stop_requested(); ++frame)
    if (!give(moment_of_slices(film_, frame), search, stop)) return;
}

void FilmPlayer::decode(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    const std::uint64_t search = search_;
    const double seconds = searched_s_;
    lock.unlock();
    std::optional<Error> failure;
    try {
      if (film_.slices.empty())
        read_from(seconds, search, stop);
      else
        read_slices_from(seconds, search, stop);
    } catch (const Error& error) {
      failure = error;
    } catch (const std::exception& error) {
      failure = Error(ErrorKind::bad_input, error.what());
    }
    lock.lock();
    if (search_ != search) continue;
    at_end_ = true;
    failure_ = failure;
    const bool is_waited_for = is_waited_for_ || failure;
    lock.unlock();
    if (is_waited_for && !stop.stop_requested()) wake_();
    lock.lock();
    changed_.wait(lock, stop, [&] { return search_ != search; });
  }
}

}  // namespace wheatstone::viewer
