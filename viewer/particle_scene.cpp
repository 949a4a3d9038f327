#include "particle_scene.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "viewer.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/depth/display_presets.h"

namespace wheatstone::viewer {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A particle that covers a place.
struct Candidate {
  float depth, parallax_px, light;
};

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

void put_choice(const ParticleChoice& choice, RenderParticlesOptions& options) {
  options.quantity = choice.quantity;
  if (!choice.where.empty()) options.choice.where = parse_condition(choice.where);
  if (!choice.type_colours.empty()) options.choice.type_colours = parse_type_colours(choice.type_colours);
}

bool reads_the_same(const ParticleChoice& a, const ParticleChoice& b) {
  return quantity_name_of(a.quantity) == quantity_name_of(b.quantity) && a.where == b.where &&
         a.type_colours == b.type_colours;
}

PerceivedDepth perceived_depth(const ViewState& state) {
  const DisplayPreset& display = find_display(state.display);
  PerceivedDepth depth;
  depth.viewing.viewing_distance_mm = display.viewing_distance_mm;
  depth.viewing.screen_width_mm = display.screen_width_mm;
  const float usual_mm = usual_depth_mm(display.screen_width_mm);
  depth.near_mm = state.look.near_mm.value_or(usual_mm);
  depth.far_mm = state.look.far_mm.value_or(usual_mm);
  depth.regions = state.depth_regions;
  return depth;
}

std::optional<Focus> focus_in(const ScreenFocus& focus, int width, int height) {
  if (!focus.at) return {};
  const auto across = static_cast<float>(width);
  return Focus{.x_px = (*focus.at)[0] * across,
               .y_px = (*focus.at)[1] * static_cast<float>(height),
               .radius_px = focus.radius * across,
               .gain = focus.gain};
}

bool has_focus(const Content& content) {
  return std::holds_alternative<ParticlesContent>(content) || std::holds_alternative<SlicesContent>(content);
}

PictureSize size_of_view(const Viewer& viewer) {
  const PictureSize content = size_of(viewer.session().opened.content);
  if (content.width > 0) return content;
  const Rig eyes = eyes_of(viewer);
  return {eyes.width, eyes.height};
}

void check_focus_in(const Viewer& viewer, const ScreenFocus& focus) {
  const Particles* const particles = open_particles(viewer);
  if (particles == nullptr || !focus.at) return;
  const ViewState& state = viewer.session().state;
  const Rig eyes = eyes_of(viewer);
  const Scene scene = particle_scene(*particles, state, eyes);
  float largest = 0;
  for (const auto& point : scene.mapping.points) largest = std::max(largest, std::abs(point.parallax_px));
  check_focus(*focus_in(focus, eyes.width, eyes.height), largest * state.adjustment.separation / 2);
}

RenderParticlesOptions render_options(const ViewState& state, const Rig& rig) {
  const ParticleLook& look = state.look;
  RenderParticlesOptions options;
  options.width = rig.width;
  options.height = rig.height;
  options.positions = rig.positions;
  options.framing = state.orbit;
  options.depth = perceived_depth(state);
  Appearance& appearance = options.appearance;
  appearance.look = drawn_look(look);
  appearance.coldest = look.coldest.value_or(unknown);
  appearance.hottest = look.hottest.value_or(unknown);
  appearance.colour_map = look.colours;
  appearance.smallest_px = look.smallest_px;
  appearance.largest_px = look.largest_px;
  appearance.opacity = look.opacity;
  options.rendering.opaque = look.opaque;
  options.rendering.focus = focus_in(look.focus, rig.width, rig.height);
  put_choice(look.choice, options);
  if (appearance.look == Look::thesis) {
    options.quantity.clear();
    options.rendering.exposure = look.exposure.value_or(unknown);
  } else {
    options.rendering.tone.stretch = look.stretch;
    options.least = look.least.value_or(unknown);
    options.most = look.most.value_or(unknown);
  }
  return options;
}

Scene particle_scene(const Particles& particles, const ViewState& state, const Rig& rig) {
  return scene_of(particles.statistics, render_options(state, rig));
}

std::optional<SeenPoint> particle_at(const Particles& particles, const Scene& scene, const PlaceInView& place) {
  constexpr std::size_t most_looked_at = 1'000'000;
  const Cloud& cloud = particles.cloud;
  const Camera& camera = scene.camera;
  const SplatStyle& style = scene.splat_style;
  const std::size_t every = cloud.size() / most_looked_at + 1;
  const float reach_px = std::max(style.largest_px / 2, 3.f);
  const float view = place.view.eye_separations();
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < cloud.size(); i += every) {
    const std::array<float, 3> at{cloud.x[i] - camera.position[0], cloud.y[i] - camera.position[1],
                                  cloud.z[i] - camera.position[2]};
    const float depth = dot(at, camera.forward);
    if (!(depth > camera.nearest_depth)) continue;
    const float px_a_unit = camera.focal_px * camera.nearness(depth);
    const float y = camera.centre_y_px + px_a_unit * dot(at, camera.down) - static_cast<float>(place.y);
    if (std::abs(y) > reach_px) continue;
    const float parallax = parallax_px(scene.mapping, depth);
    const float x =
        camera.centre_x_px + px_a_unit * dot(at, camera.right) + view * parallax - static_cast<float>(place.x);
    if (x * x + y * y > reach_px * reach_px) continue;
    float light = 1;
    if (!cloud.density.empty())
      light /= 1 + std::exp2(-style.slope * (std::log2(cloud.density[i]) - style.log2_density_middle));
    found.push_back({depth, parallax, light});
  }
  if (found.empty()) return {};
  const float brightest = std::ranges::max_element(found, {}, &Candidate::light)->light;
  std::erase_if(found, [brightest](const Candidate& one) { return one.light < brightest / 2; });
  const Candidate nearest = *std::ranges::min_element(found, {}, &Candidate::depth);
  return SeenPoint{point_at_depth({camera, scene.mapping}, place, nearest.depth), nearest.parallax_px};
}

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
  const bool is_wanted = reads_the_same(state.look.choice, particles->choice);
  if (!is_wanted) {
    options.choice = {};
    put_choice(particles->choice, options);
    if (!is_mass) options.quantity.clear();
  }
  if (is_mass && (std::isnan(options.least) || std::isnan(options.most))) {
    const Brightness found = brightness_for(particles->statistics, options);
    if (std::isnan(options.least)) options.least = found.least;
    if (std::isnan(options.most)) options.most = found.most;
  }
  // Fewer particles have less light, but for those that hide each other; a mean stays as it is.
  const float light = options.rendering.opaque ? 1.f : static_cast<float>(every);
  const float fewer = quantity_name_of(particles->choice.quantity).empty() ? light : 1.f;
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
    if (!particles->redshift) rendered.time = particles->time;
    annotate(rendered, rendered.rendered.views,
             {.title = state.look.title, .behind_mm = state.look.annotation_behind_mm});
  }
  return {std::move(rendered.rendered.views),
          {.exposure = rendered.rendered.exposure / light, .least = rendered.least, .most = rendered.most},
          every == 1 && is_wanted};
}

const Particles* open_particles(const Viewer& viewer) {
  const auto* const content = std::get_if<ParticlesContent>(&viewer.session().opened.content);
  return content != nullptr ? content->particles.get() : nullptr;
}

}  // namespace wheatstone::viewer
