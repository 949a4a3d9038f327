#include "particle_drawer.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>

#include "particle_scene.h"
#include "wheatstone/multiview/render.h"

namespace wheatstone::viewer {
namespace {

constexpr double quick_s = 0.1;
constexpr std::size_t least_particles = 20'000;  ///< which are drawn as quickly as none

template <class Value>
std::vector<Value> every_nth(const std::vector<Value>& values, std::size_t every) {
  std::vector<Value> some;
  some.reserve(values.size() / every + 1);
  for (std::size_t i = 0; i < values.size(); i += every) some.push_back(values[i]);
  return some;
}

Cloud every_nth(const Cloud& cloud, std::size_t every) {
  Cloud some;
  some.x = every_nth(cloud.x, every);
  some.y = every_nth(cloud.y, every);
  some.z = every_nth(cloud.z, every);
  some.density = every_nth(cloud.density, every);
  some.temperature = every_nth(cloud.temperature, every);
  some.smoothing_length = every_nth(cloud.smoothing_length, every);
  some.colour = every_nth(cloud.colour, every);
  some.origin = cloud.origin;
  some.box_size = cloud.box_size;
  return some;
}

}  // namespace

std::size_t ParticleDrawer::share_for(std::size_t particles) const {
  const auto wanted = static_cast<std::size_t>(static_cast<double>(particles) * seconds_a_particle_ / quick_s);
  const std::size_t most = std::max<std::size_t>(particles / least_particles, 1);
  // What was kept serves as long as it is drawn in about the time, so that the picture does not flicker.
  if (wanted <= every_ && every_ <= 4 * wanted + 1) return std::min(every_, most);
  return std::min(std::bit_ceil(std::max<std::size_t>(wanted, 1)), most);
}

const Cloud& ParticleDrawer::thinned(const std::shared_ptr<const Particles>& particles, std::size_t every) {
  if (of_ != particles || every_ != every) thinned_ = every > 1 ? every_nth(particles->cloud, every) : Cloud();
  of_ = particles;
  every_ = every;
  return every > 1 ? thinned_ : particles->cloud;
}

DrawnParticles ParticleDrawer::draw(const std::shared_ptr<const Particles>& particles, const ViewState& state,
                                    const Rig& rig, Effort effort) {
  const std::size_t every = effort == Effort::quick ? share_for(particles->cloud.size()) : 1;
  const Cloud& cloud = effort == Effort::quick ? thinned(particles, every) : particles->cloud;
  // Particles that hide each other do not add their light.
  const float light = state.look.opaque ? 1.f : static_cast<float>(every);
  const Scene scene = particle_scene(*particles, state, rig);
  const RenderOptions options{
      .device = Device::automatic,
      .opaque = state.look.opaque,
      .exposure = state.look.exposure ? *state.look.exposure * light : std::numeric_limits<float>::quiet_NaN()};
  const auto start = std::chrono::steady_clock::now();
  RenderedViews rendered = render(cloud, scene, rig, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  seconds_a_particle_ += 0.3 * (seconds / static_cast<double>(cloud.size()) - seconds_a_particle_);
  return {std::move(rendered.views), rendered.exposure / light, every == 1};
}

}  // namespace wheatstone::viewer
