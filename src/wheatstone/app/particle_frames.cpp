#include "wheatstone/app/particle_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {

ParticleFrames::ParticleFrames(const std::string& input, const ParticleFramesOptions& options, const Progress& progress)
    : options_(options), input_(input) {
  RenderParticlesOptions& particles = options_.particles;
  if (particles.stream)
    throw Error(ErrorKind::wrong_usage, "particles of a film cannot be streamed: all of them are held in memory");
  make_splat_style(particles.appearance, {});  // what makes no sense is said before the long work
  std::optional<SnapshotSeries> series = find_series(input, particles.choice);
  if (options_.count == 0) options_.count = series ? static_cast<int>(series->files.size()) : 1;
  if (series) series_.emplace(*std::move(series), choice_of(particles));
  survey(input, progress);
  const CloudSource first = open_cloud(series_ ? series_->series().files.front() : input_, choice_of(particles));
  units_ = units_of(first, particles, statistics_.has_mass);
  redshift_ = first.redshift;
  if (!redshift_) time_ = first.time;
}

/// Learns what is held through the film.
void ParticleFrames::survey(const std::string& input, const Progress& progress) {
  const RenderParticlesOptions& particles = options_.particles;
  if (!series_) {
    still_ = read_particles(input, particles, progress);
    statistics_ = still_.statistics;
    return hold_brightness({statistics_, statistics_});
  }
  const SnapshotSeries& series = series_->series();
  const std::array<double, 2> ends{moment_of(0).time, moment_of(options_.count - 1).time};
  std::array<CloudStatistics, 2> at_ends;
  for (std::size_t i = 0; i < series.files.size(); ++i) {
    const Progress of_all = [&](std::string_view /*step*/, double /*done*/) {
      report(progress, "statistics", static_cast<double>(i) / static_cast<double>(series.files.size()));
    };
    const ReadyParticles snapshot =
        ready_particles(series_->at(series.times[i], of_all), series.files[i], particles, of_all);
    statistics_.add(snapshot.cloud);
    // The last snapshot that is not after a frame stands for it.
    for (const std::size_t end : {0, 1})
      if (i == 0 || series.times[i] <= ends[end]) at_ends[end] = snapshot.statistics;
  }
  statistics_.framed = framed_region(statistics_, particles.fit);
  hold_brightness(at_ends);
}

/// Takes the darker of the choices for the first and the last frame, so that no frame is too bright.
void ParticleFrames::hold_brightness(const std::array<CloudStatistics, 2>& at_ends) {
  RenderParticlesOptions& options = options_.particles;
  const bool thesis = options.appearance.look == Look::thesis;
  if (thesis ? !std::isnan(options.rendering.exposure) : !std::isnan(options.least) && !std::isnan(options.most))
    return;
  const auto at = [&](std::size_t end) {
    const int number = end == 0 ? 0 : options_.count - 1;
    return brightness_for(held(at_ends[end]), options_of_frame(options_, number, moment_of(number).key));
  };
  const Brightness first = at(0);
  const Brightness last = options_.count > 1 ? at(1) : first;
  if (thesis) {
    options.rendering.exposure = std::min(first.exposure, last.exposure);
  } else {
    options.least = std::min(first.least, last.least);
    options.most = std::max(first.most, last.most);
  }
}

/// The statistics that frame the views and colour the particles are held through the film; count, mass, sample and grid
/// are the frame's own.
CloudStatistics ParticleFrames::held(CloudStatistics of_frame) const {
  if (!series_) return of_frame;
  CloudStatistics held = statistics_;
  held.count = of_frame.count;
  held.mass = of_frame.mass;
  held.sample = std::move(of_frame.sample);
  held.grid = std::move(of_frame.grid);
  return held;
}

ParticleFrames::Moment ParticleFrames::moment_of(int number) const {
  Moment moment{.key = key_of_frame(options_, number)};
  if (!series_) return moment;
  const std::vector<double>& times = series_->series().times;
  moment.time = moment.key.time.value_or(std::lerp(times.front(), times.back(), share_of_frame(options_, number)));
  return moment;
}

double share_of_frame(const ParticleFramesOptions& film, int number) {
  return film.count > 1 ? static_cast<double>(number) / (film.count - 1) : 0;
}

CameraKey key_of_frame(const ParticleFramesOptions& film, int number) {
  return film.path ? camera_at(*film.path, share_of_frame(film, number)) : CameraKey();
}

RenderParticlesOptions options_of_frame(const ParticleFramesOptions& film, int number, const CameraKey& key) {
  RenderParticlesOptions options = film.particles;
  Framing& framing = options.framing;
  turn_as(key, framing);
  if (key.centre) options.look_at = key.centre;
  framing.azimuth_deg += film.orbit_deg * static_cast<float>(number) / static_cast<float>(film.count);
  return options;
}

RenderedParticles ParticleFrames::frame(int number, const Progress& progress) {
  const Moment moment = moment_of(number);
  const RenderParticlesOptions options = options_of_frame(options_, number, moment.key);
  RenderedParticles rendered = series_ ? render_ready(particles_at(moment.time, progress), options, progress)
                                       : render_ready(still_, options, progress);
  rendered.units = units_;
  rendered.redshift = redshift_;
  rendered.time = time_;
  // The time of a universe that expands is its scale factor.
  if (series_ && redshift_) rendered.redshift = 1 / moment.time - 1;
  if (series_ && time_) rendered.time = moment.time;
  return rendered;
}

ReadyParticles ParticleFrames::particles_at(double time, const Progress& progress) {
  ReadyParticles particles = ready_particles(series_->at(time, progress), input_, options_.particles, progress);
  particles.statistics = held(std::move(particles.statistics));
  return particles;
}

}  // namespace wheatstone
