// What a viewer does with a film that is open.

#include <chrono>
#include <memory>
#include <utility>

#include "particle_film.h"
#include "viewer.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

double steady_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

void Viewer::take_film(const std::shared_ptr<const OpenedFilm>& film) {
  if (!film) return;
  player_ = std::make_unique<FilmPlayer>(film->film, film->first, [this] { mailbox_.post([] {}); });
  session_.film =
      FilmStatus{.frame = film->first.frame, .seconds = film->first.seconds, .duration_s = film->film.facts.duration_s};
}

void Viewer::play_film() {
  if (session_.film && session_.film->of_particles) {
    FilmStatus& film = *session_.film;
    film.plays = true;
    if (film.seconds >= film.duration_s) show_particles_at(0);
    return;
  }
  if (!player_) return;
  player_->play(steady_s());
  session_.film->plays = true;
  // The painting is not finished; what plays is the film.
  ++job_;
  making_.stop();
  session_.opening.reset();
}

void Viewer::step_film(int frames) {
  if (session_.film && session_.film->of_particles) {
    session_.film->plays = false;
    show_particles_at(session_.film->seconds + frames / particle_frames_a_second);
  } else if (player_) {
    player_->step(frames);
  }
}

void Viewer::seek_film(double seconds) {
  if (session_.film && session_.film->of_particles) {
    show_particles_at(seconds);
  } else if (player_) {
    player_->seek(seconds);
  }
}

void Viewer::pause_film() {
  if (session_.film && session_.film->of_particles) session_.film->plays = false;
  if (!player_ || !player_->plays()) return;
  player_->pause();
  session_.film->plays = false;
  show_standing_frame();
}

void Viewer::show_standing_frame() {
  if (!session_.film || session_.film->of_particles || session_.film->plays) return;
  if (session_.film->paints) {
    paint();
    return;
  }
  ++job_;
  making_.stop();
  session_.opening.reset();
  if (auto* const content = std::get_if<PaintedContent>(&session_.opened.content)) content->painting.reset();
}

void Viewer::move_film(double now_s) {
  if (!player_) return;
  const bool played = session_.film->plays;
  try {
    if (const std::unique_ptr<FilmMoment> moment = player_->due(now_s)) {
      ++job_;
      making_.stop();
      session_.opening.reset();
      session_.opened.content = moment->content;
      session_.film->frame = moment->frame;
      session_.film->seconds = moment->seconds;
      if (!player_->plays() && !player_->is_seeking()) {
        session_.film->plays = false;
        show_standing_frame();
        return;
      }
    }
  } catch (const Error& error) {
    tell(error.what(), true);
  }
  session_.film->plays = player_->plays();
  // At its end the film stands.
  if (played && !session_.film->plays) show_standing_frame();
}

void Viewer::paint_whole_film(const std::filesystem::path& output) {
  if (!player_) throw Error(ErrorKind::wrong_usage, "no film is open");
  if (!player_->film().slices.empty())
    throw Error(ErrorKind::wrong_usage, "a film of slices is not painted; 'wheatstone render' makes films of it");
  if (whole_film_) throw Error(ErrorKind::wrong_usage, "a film is being painted; 'cancel' stops that");
  session_.whole_film = Activity{"painting the film", 0};
  whole_film_ = std::make_unique<FilmPainting>(
      WholeFilm{player_->film().files, session_.state.style, output},
      FilmPainting::Listener{
          .progress =
              [this](std::string step, double done) {
                mailbox_.post([this, activity = Activity{std::move(step), done}] { session_.whole_film = activity; });
              },
          .end =
              [this](std::string message, bool is_error) {
                mailbox_.post([this, message = std::move(message), is_error] {
                  whole_film_.reset();
                  session_.whole_film.reset();
                  tell(message, is_error);
                });
              }});
}

void Viewer::cancel_whole_film() {
  if (whole_film_) whole_film_->cancel();
}

}  // namespace wheatstone::viewer
