#include "particle_drawer.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "particle_scene.h"
#include "wheatstone/app/annotate.h"

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
  some.mass = every_nth(cloud.mass, every);
  some.quantity = every_nth(cloud.quantity, every);
  some.presence = every_nth(cloud.presence, every);
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

const ReadyParticles& ParticleDrawer::thinned(const std::shared_ptr<const Particles>& particles, std::size_t every) {
  if (of_ != particles || every_ != every) {
    thinned_ = {};
    if (every > 1) thinned_ = {.cloud = every_nth(particles->cloud, every), .statistics = particles->statistics};
  }
  of_ = particles;
  every_ = every;
  if (every == 1) return *particles;
  return thinned_;
}

DrawnParticles ParticleDrawer::draw(const std::shared_ptr<const Particles>& particles, const ViewState& state,
                                    const Rig& rig, Effort effort) {
  const std::size_t every = effort == Effort::quick ? share_for(particles->cloud.size()) : 1;
  const ReadyParticles& drawn = effort == Effort::quick ? thinned(particles, every) : *particles;
  RenderParticlesOptions options = render_options(state, rig);
  options.rendering.device = Device::automatic;
  const bool is_mass = options.appearance.look == Look::mass;
  // Until what is to be shown has been read, what has been is shown.
  const bool is_wanted = !is_mass || quantity_name_of(options.quantity) == particles->quantity;
  if (!is_wanted) options.quantity = particles->quantity;
  if (is_mass && (std::isnan(options.least) || std::isnan(options.most))) {
    const Brightness found = brightness_for(particles->statistics, options);
    if (std::isnan(options.least)) options.least = found.least;
    if (std::isnan(options.most)) options.most = found.most;
  }
  // Fewer particles have less light, but for those that hide each other; a mean stays as it is.
  const float light = options.rendering.opaque ? 1.f : static_cast<float>(every);
  const float fewer = particles->quantity.empty() ? light : 1.f;
  options.rendering.exposure *= light;
  options.least /= fewer;
  options.most /= fewer;
  const auto start = std::chrono::steady_clock::now();
  RenderedParticles rendered = render_ready(drawn, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  seconds_a_particle_ += 0.3 * (seconds / static_cast<double>(drawn.cloud.size()) - seconds_a_particle_);
  rendered.least *= fewer;
  rendered.most *= fewer;
  if (state.look.annotated) {
    rendered.units = particles->units;
    rendered.redshift = particles->redshift;
    annotate(rendered, rendered.rendered.views);
  }
  return {std::move(rendered.rendered.views),
          {.exposure = rendered.rendered.exposure / light, .least = rendered.least, .most = rendered.most},
          every == 1 && is_wanted};
}

}  // namespace wheatstone::viewer
