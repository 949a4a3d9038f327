#include "particle_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "particle_reader.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

constexpr double interval_s = 2;  ///< from a snapshot to the next
constexpr double path_s = 10;     ///< of one snapshot
constexpr double longest_s = 120;

const Particles& particles_of(const Session& session) {
  const auto* const content = std::get_if<ParticlesContent>(&session.opened.content);
  if (content == nullptr) throw Error(ErrorKind::wrong_usage, "no particles are open");
  return *content->particles;
}

/// Steps of a path that differ by less show one frame.
double half_a_frame(const Session& session) {
  return 0.5 / (particle_film_s(session).value_or(path_s) * particle_frames_a_second);
}

}  // namespace

std::optional<double> particle_film_s(const Session& session) {
  if (!session.opened.reader) return {};
  const std::size_t snapshots = session.opened.reader->times().size();
  if (snapshots > 0) return std::min(static_cast<double>(snapshots - 1) * interval_s, longest_s);
  if (session.camera_path.keys.empty()) return {};
  return path_s;
}

double series_time(const Session& session) {
  const std::vector<double>& times = session.opened.reader->times();
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
  const std::array<double, 3>& origin = particles_of(session).cloud.origin;
  orbit.look_at.emplace();
  for (std::size_t axis = 0; axis < 3; ++axis)
    (*orbit.look_at)[axis] = static_cast<float>((*key.centre)[axis] - origin[axis]);
}

CameraKey key_here(const Session& session) {
  const Particles& particles = particles_of(session);
  const Framing& orbit = session.state.orbit;
  constexpr float most_zoom = 1000;  // in a path, as of render
  if (orbit.zoom > most_zoom)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the magnification is {}, a keyframe has at most {}", orbit.zoom, most_zoom));
  const std::array<float, 3> middle = orbit.look_at.value_or(particles.statistics.centre());
  CameraKey key{.at = session.state.share,
                .azimuth_deg = orbit.azimuth_deg,
                .elevation_deg = orbit.elevation_deg,
                .field_of_view_deg = orbit.field_of_view_deg,
                .zoom = orbit.zoom,
                .centre = std::array<double, 3>()};
  for (std::size_t axis = 0; axis < 3; ++axis)
    (*key.centre)[axis] = static_cast<double>(middle[axis]) + particles.cloud.origin[axis];
  const std::vector<CameraKey>& keys = session.camera_path.keys;
  // Where the path says when, so do all of its keys; elsewhere time goes on evenly.
  if (std::ranges::any_of(keys, [](const CameraKey& other) { return other.time.has_value(); }))
    key.time = session.opened.reader->times().empty() ? std::nullopt : std::optional(series_time(session));
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
