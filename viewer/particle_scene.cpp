#include "particle_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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

}  // namespace

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
  if (appearance.look == Look::thesis) {
    options.rendering.exposure = look.exposure.value_or(unknown);
  } else {
    options.quantity = look.quantity;
    options.rendering.tone.stretch = look.stretch;
    options.least = look.least.value_or(unknown);
    options.most = look.most.value_or(unknown);
  }
  return options;
}

Scene particle_scene(const Particles& particles, const ViewState& state, const Rig& rig) {
  return scene_of(particles.statistics, render_options(state, rig));
}

std::optional<SeenParticle> particle_at(const Particles& particles, const Scene& scene, const PlaceInView& place) {
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
    const float y = camera.centre_y_px + camera.focal_px * dot(at, camera.down) / depth - static_cast<float>(place.y);
    if (std::abs(y) > reach_px) continue;
    const float parallax = parallax_px(scene.mapping, depth);
    const float x = camera.centre_x_px + camera.focal_px * dot(at, camera.right) / depth + view * parallax -
                    static_cast<float>(place.x);
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
  const float right = (static_cast<float>(place.x) - view * nearest.parallax_px - camera.centre_x_px) / camera.focal_px;
  const float down = (static_cast<float>(place.y) - camera.centre_y_px) / camera.focal_px;
  SeenParticle seen{.parallax_px = nearest.parallax_px};
  for (std::size_t axis = 0; axis < 3; ++axis)
    seen.position[axis] = camera.position[axis] + nearest.depth * (camera.forward[axis] + right * camera.right[axis] +
                                                                   down * camera.down[axis]);
  return seen;
}

std::array<float, 3> moved_look_at(const Particles& particles, const ViewState& state, const Rig& rig, double x_px,
                                   double y_px) {
  const std::array<float, 3> middle = state.orbit.look_at.value_or(particles.statistics.centre());
  const Camera camera = particle_scene(particles, state, rig).camera;
  std::array<float, 3> moved{}, from_camera{};
  for (std::size_t axis = 0; axis < 3; ++axis) from_camera[axis] = middle[axis] - camera.position[axis];
  const float units_a_pixel = dot(from_camera, camera.forward) / camera.focal_px;
  for (std::size_t axis = 0; axis < 3; ++axis)
    moved[axis] = middle[axis] - units_a_pixel * (static_cast<float>(x_px) * camera.right[axis] +
                                                  static_cast<float>(y_px) * camera.down[axis]);
  return moved;
}

}  // namespace wheatstone::viewer
