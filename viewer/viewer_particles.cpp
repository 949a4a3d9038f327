// What a viewer does with particles that move: a series of snapshots, or a camera on its path.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbit.h"
#include "particle_film.h"
#include "particle_scene.h"
#include "viewer.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

/// What a series shows: the redshift where its time is the scale factor.
std::string moment_told(const Particles& particles, double time) {
  if (particles.redshift) return fmt::format("z = {:.3f}", std::max(1 / time - 1, 0.));
  return fmt::format("time {:.5g}", time);
}

}  // namespace

void Viewer::take_particles() {
  if (!orbited(session_.opened.content)) return;
  const std::optional<double> duration_s = particle_film_s(session_);
  if (!duration_s) {
    session_.film.reset();
    return;
  }
  if (!session_.film) session_.film = FilmStatus{.of_particles = true};
  session_.film->duration_s = *duration_s;
  show_particles_at(session_.film->seconds);
}

void Viewer::take_camera_path(CameraPath path, std::filesystem::path file) {
  session_.camera_path = std::move(path);
  session_.camera_file = std::move(file);
  take_particles();
}

void Viewer::show_particles_at(double seconds) {
  FilmStatus& film = *session_.film;
  film.seconds = std::clamp(seconds, 0., film.duration_s);
  film.frame = std::llround(film.seconds * particle_frames_a_second);
  session_.state.share = film.seconds / film.duration_s;
  if (!session_.camera_path.keys.empty()) look_along(session_);
  if (!times_of(session_).empty()) film.moment = moment_told(*open_particles(*this), series_time(session_));
}

void Viewer::move_particles(double passed_s) {
  if (session_.film && session_.film->of_particles && session_.film->plays) {
    show_particles_at(session_.film->seconds + passed_s);
    if (session_.film->seconds >= session_.film->duration_s) session_.film->plays = false;
  }
  read_wanted_particles();
}

void Viewer::read_wanted_particles() {
  const Particles* const particles = open_particles(*this);
  if (particles == nullptr || !session_.opened.reader || reads_particles_ || session_.opening) return;
  const ParticleChoice& choice = session_.state.look.choice;
  const bool is_series = !times_of(session_).empty();
  const double time = is_series ? series_time(session_) : 0;
  const bool is_other = !reads_the_same(choice, particles->choice);
  if (!is_other && (!is_series || time == particles->time || time == failed_time_)) return;
  if (is_other) session_.opening = Activity{"reading", 0};
  reads_particles_ = true;
  read_particles_for(choice, time);
}

void Viewer::read_particles_for(const ParticleChoice& choice, double time) {
  const std::uint64_t job = ++job_;
  making_.start([this, job, choice, time, reader = session_.opened.reader](const std::stop_token& stop) {
    try {
      const std::shared_ptr<const Particles> read = reader->read(choice, time, progress_of(job, stop));
      mailbox_.post([this, job, read] {
        if (job != job_) return;
        reads_particles_ = false;
        session_.opening.reset();
        session_.opened.content = ParticlesContent{read};
      });
    } catch (const Error& error) {
      post_particles_failure(error, time, job);
    } catch (const std::exception& error) {
      post_particles_failure(Error(ErrorKind::bad_input, error.what()), time, job);
    }
  });
}

/// What was open stays, and so does what it shows.
void Viewer::post_particles_failure(const Error& error, double time, std::uint64_t job) {
  mailbox_.post([this, job, time, message = std::string(error.what())] {
    if (job != job_) return;
    reads_particles_ = false;
    session_.opening.reset();
    const Particles& particles = *open_particles(*this);
    if (!reads_the_same(session_.state.look.choice, particles.choice)) {
      session_.state.look.choice = particles.choice;
      forget_brightness(session_.state.look);
    } else {
      session_.film->plays = false;
      failed_time_ = time;
    }
    tell(message, true);
  });
}

}  // namespace wheatstone::viewer
