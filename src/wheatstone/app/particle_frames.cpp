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
  hold_brightness();
}

/// Learns what is held through the film.
void ParticleFrames::survey(const std::string& input, const Progress& progress) {
  const RenderParticlesOptions& particles = options_.particles;
  if (!series_) {
    still_ = read_particles(input, particles, progress);
    statistics_ = still_.statistics;
    return;
  }
  const SnapshotSeries& series = series_->series();
  for (std::size_t i = 0; i < series.files.size(); ++i) {
    const Progress of_all = [&](std::string_view /*step*/, double /*done*/) {
      report(progress, "statistics", static_cast<double>(i) / static_cast<double>(series.files.size()));
    };
    statistics_.add(ready_particles(series_->at(series.times[i], of_all), series.files[i], particles, of_all).cloud);
  }
  statistics_.framed = framed_region(statistics_, particles.fit);
}

/// The darker of what the first and the last frame would choose: nothing is too bright.
void ParticleFrames::hold_brightness() {
  RenderParticlesOptions& options = options_.particles;
  const bool thesis = options.appearance.look == Look::thesis;
  if (thesis ? !std::isnan(options.rendering.exposure) : !std::isnan(options.least) && !std::isnan(options.most))
    return;
  RenderedParticles first = frame(0);
  if (options_.count > 1) {
    const RenderedParticles last = frame(options_.count - 1);
    first.rendered.exposure = std::min(first.rendered.exposure, last.rendered.exposure);
    first.least = std::min(first.least, last.least);
    first.most = std::max(first.most, last.most);
  }
  if (thesis) {
    options.rendering.exposure = first.rendered.exposure;
  } else {
    options.least = first.least;
    options.most = first.most;
  }
}

double ParticleFrames::share_of(int number) const {
  return options_.count > 1 ? static_cast<double>(number) / (options_.count - 1) : 0;
}

RenderParticlesOptions ParticleFrames::options_at(int number, const CameraKey& key) const {
  RenderParticlesOptions options = options_.particles;
  Framing& framing = options.framing;
  const auto take = [](const std::optional<double>& from, float& to) {
    if (from) to = static_cast<float>(*from);
  };
  take(key.azimuth_deg, framing.azimuth_deg);
  take(key.elevation_deg, framing.elevation_deg);
  take(key.field_of_view_deg, framing.field_of_view_deg);
  take(key.zoom, framing.zoom);
  if (key.centre) options.look_at = key.centre;
  framing.azimuth_deg += options_.orbit_deg * static_cast<float>(number) / static_cast<float>(options_.count);
  return options;
}

RenderedParticles ParticleFrames::frame(int number, const Progress& progress) {
  const CameraKey key = options_.path ? camera_at(*options_.path, share_of(number)) : CameraKey();
  const RenderParticlesOptions options = options_at(number, key);
  if (!series_) return render_ready(still_, options, progress);
  const std::vector<double>& times = series_->series().times;
  const double time = key.time.value_or(std::lerp(times.front(), times.back(), share_of(number)));
  ReadyParticles particles = ready_particles(series_->at(time, progress), input_, options, progress);
  // What frames the views and colours the particles is held; how many there are is the frame's own.
  CloudStatistics held = statistics_;
  held.count = particles.statistics.count;
  held.mass = particles.statistics.mass;
  held.sample = std::move(particles.statistics.sample);
  particles.statistics = std::move(held);
  return render_ready(particles, options, progress);
}

}  // namespace wheatstone
