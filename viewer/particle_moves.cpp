#include "particle_moves.h"

#include <algorithm>

#include "particle_scene.h"

namespace wheatstone::viewer {
namespace {

constexpr float least_zoom = 0.01f, most_zoom = 1e6f;

}  // namespace

const Particles* open_particles(const Viewer& viewer) {
  const auto* const content = std::get_if<ParticlesContent>(&viewer.session().opened.content);
  return content != nullptr ? content->particles.get() : nullptr;
}

Rig eyes_of(const Viewer& viewer) {
  const ViewState& state = viewer.session().state;
  const PictureSize eye = eye_size(find_output_mode(state.mode), viewer.viewport());
  const EyePositions positions = eye_positions(state);
  return {std::max(eye.width, 1), std::max(eye.height, 1), {positions.left, positions.right}};
}

bool pan_particles(Viewer& viewer, double x_px, double y_px) {
  const Particles* const particles = open_particles(viewer);
  if (particles == nullptr) return false;
  ViewState& state = viewer.session().state;
  state.orbit.look_at = moved_look_at(*particles, state, eyes_of(viewer), x_px, y_px);
  return true;
}

bool magnify_particles(Viewer& viewer, double factor, double x_px, double y_px) {
  if (open_particles(viewer) == nullptr) return false;
  float& zoom = viewer.session().state.orbit.zoom;
  const float before = zoom;
  zoom = std::clamp(before * static_cast<float>(factor), least_zoom, most_zoom);
  const double magnified = zoom / before;
  return (x_px == 0 && y_px == 0) || pan_particles(viewer, x_px * (1 - magnified), y_px * (1 - magnified));
}

bool fit_particles(Viewer& viewer) {
  if (open_particles(viewer) == nullptr) return false;
  wheatstone::Framing& orbit = viewer.session().state.orbit;
  orbit.zoom = ViewState().orbit.zoom;
  orbit.look_at.reset();
  return true;
}

}  // namespace wheatstone::viewer
