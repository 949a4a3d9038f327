#include "particle_film.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "orbit.h"
#include "particle_scene.h"
#include "wheatstone/app/snapshot_series.h"
#include "wheatstone/error.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::viewer {
namespace {

constexpr double interval_s = 2;  ///< from a snapshot to the next
constexpr double path_s = 10;     ///< of one snapshot
constexpr double longest_s = 120;

/// Steps of a path that differ by less show one frame.
double half_a_frame(const Session& session) {
  return 0.5 / (particle_film_s(session).value_or(path_s) * particle_frames_a_second);
}

}  // namespace

ParticleReader::ParticleReader(std::filesystem::path input) : input_(std::move(input)), first_(input_) {
  if (const std::optional<SnapshotSeries> series = find_series(input_.string())) {
    times_ = series->times;
    first_ = series->files.front();
  }
  const CloudSource source = open_cloud(first_);
  fields_ = source.fields;
  time_is_scale_factor_ = source.time && source.redshift;
}

std::shared_ptr<const Particles> ParticleReader::read(const ParticleChoice& choice, double time,
                                                      const Progress& progress) {
  auto particles = std::make_shared<Particles>();
  RenderParticlesOptions options;
  put_choice(choice, options);
  const CloudSource source = open_cloud(first_, choice_of(options));
  if (times_.empty()) {
    static_cast<ReadyParticles&>(*particles) = read_particles(input_, options, progress);
    particles->redshift = source.redshift;
    particles->time = source.time;
  } else {
    if (!frames_ || frames_choice_ != choice) {
      frames_.reset();
      frames_.emplace(input_.string(), ParticleFramesOptions{.particles = options, .count = 2, .path = {}}, progress);
      frames_choice_ = choice;
    }
    static_cast<ReadyParticles&>(*particles) = frames_->particles_at(time, progress);
    particles->time = time;
    if (time_is_scale_factor_) particles->redshift = 1 / time - 1;
  }
  particles->choice = choice;
  particles->units = units_of(source, options, particles->statistics.has_mass);
  return particles;
}

std::optional<std::filesystem::path> series_pattern_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view digits = "0123456789";
  const std::string stem = file.stem().string();
  const std::size_t last = stem.find_last_of(digits);
  if (last == std::string::npos || name.find('%') != std::string::npos) return {};
  const std::size_t before = stem.find_last_not_of(digits, last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  const std::size_t count = last + 1 - first;
  const std::string number = count > 1 ? fmt::format("%0{}d", count) : "%d";
  std::filesystem::path path = file.parent_path() / (name.substr(0, first) + number + name.substr(last + 1));
  const std::optional<FramePattern> pattern = frame_pattern(path);
  if (!pattern || !pattern->number_of(name) || numbers_of(*pattern).size() < 2) return {};
  return path;
}

std::optional<std::filesystem::path> series_of_files(const std::vector<std::filesystem::path>& files) {
  if (files.size() < 2) return {};
  const std::optional<std::filesystem::path> pattern = series_pattern_of(files.front());
  if (!pattern || numbers_of(*frame_pattern(*pattern)).size() != files.size()) return {};
  const auto is_of_it = [&](const std::filesystem::path& file) { return series_pattern_of(file) == pattern; };
  return std::ranges::all_of(files, is_of_it) && holds_particles(files.front()) ? pattern : std::nullopt;
}

std::span<const double> times_of(const Session& session) {
  return session.opened.reader ? std::span(session.opened.reader->times()) : std::span<const double>();
}

std::optional<double> particle_film_s(const Session& session) {
  if (!orbited(session.opened.content)) return {};
  const std::size_t snapshots = times_of(session).size();
  if (snapshots > 0) return std::min(static_cast<double>(snapshots - 1) * interval_s, longest_s);
  if (session.camera_path.keys.empty()) return {};
  return path_s;
}

double series_time(const Session& session) {
  const std::span<const double> times = times_of(session);
  const double share = session.state.share;
  const double time =
      camera_at(session.camera_path, share).time.value_or(std::lerp(times.front(), times.back(), share));
  return std::clamp(time, times.front(), times.back());
}

void look_along(Session& session) {
  const CameraKey key = camera_at(session.camera_path, session.state.share);
  Framing& orbit = session.state.orbit;
  turn_as(key, orbit);
  if (!key.centre) return;
  const std::array<double, 3> origin = orbited(session.opened.content)->origin;
  orbit.look_at.emplace();
  for (std::size_t axis = 0; axis < 3; ++axis)
    (*orbit.look_at)[axis] = static_cast<float>((*key.centre)[axis] - origin[axis]);
}

CameraKey key_here(const Session& session) {
  const Orbited open = orbited_or_refuse(session.opened.content);
  const Framing& orbit = session.state.orbit;
  constexpr float most_zoom = 1000;  // in a path, as of render
  if (orbit.zoom > most_zoom)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the magnification is {}, a keyframe has at most {}", orbit.zoom, most_zoom));
  const std::array<float, 3> middle = orbit.look_at.value_or(open.middle);
  CameraKey key{.at = session.state.share,
                .azimuth_deg = orbit.azimuth_deg,
                .elevation_deg = orbit.elevation_deg,
                .field_of_view_deg = orbit.field_of_view_deg,
                .zoom = orbit.zoom,
                .centre = std::array<double, 3>()};
  for (std::size_t axis = 0; axis < 3; ++axis)
    (*key.centre)[axis] = static_cast<double>(middle[axis]) + open.origin[axis];
  const std::vector<CameraKey>& keys = session.camera_path.keys;
  // Where the path says when, so do all of its keys; elsewhere time goes on evenly.
  if (std::ranges::any_of(keys, [](const CameraKey& other) { return other.time.has_value(); }))
    key.time = times_of(session).empty() ? std::nullopt : std::optional(series_time(session));
  return key;
}

CameraPath with_key(const Session& session, const CameraKey& key) {
  CameraPath path = session.camera_path;
  const double half = half_a_frame(session);
  std::erase_if(path.keys, [&](const CameraKey& other) { return std::abs(other.at - key.at) < half; });
  path.keys.insert(std::ranges::upper_bound(path.keys, key.at, {}, &CameraKey::at), key);
  // The short way round.
  for (std::size_t i = 1; i < path.keys.size(); ++i) {
    const std::optional<double>& before = path.keys[i - 1].azimuth_deg;
    std::optional<double>& azimuth = path.keys[i].azimuth_deg;
    if (path.keys[i] == key && before && azimuth) *azimuth = *before + std::remainder(*azimuth - *before, 360);
  }
  return path;
}

CameraPath without_nearest_key(const Session& session) {
  CameraPath path = session.camera_path;
  const double share = session.state.share;
  const auto away = [share](const CameraKey& key) { return std::abs(key.at - share); };
  path.keys.erase(std::ranges::min_element(path.keys, {}, away));
  return path;
}

}  // namespace wheatstone::viewer
