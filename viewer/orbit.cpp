#include "orbit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "particle_scene.h"
#include "viewer.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

constexpr float least_zoom = 0.01f, most_zoom = 1e6f;

const Content& content_of(const Viewer& viewer) { return viewer.session().opened.content; }

}  // namespace

std::optional<Orbited> orbited(const Content& content) {
  if (const auto* const particles = std::get_if<ParticlesContent>(&content))
    return Orbited{particles->particles->cloud.origin, particles->particles->statistics.centre()};
  if (const auto* const model = std::get_if<ModelContent>(&content)) return Orbited{model->model->origin, {}};
  return {};
}

Orbited orbited_or_refuse(const Content& content) {
  if (const std::optional<Orbited> open = orbited(content)) return *open;
  throw Error(ErrorKind::wrong_usage, "no particles and no model are open");
}

OrbitedScene orbited_scene(const Content& content, const ViewState& state, const Rig& rig) {
  if (const auto* const model = std::get_if<ModelContent>(&content)) {
    ModelScene scene = scene_of(*model->model, render_options(state, rig));
    return {scene.camera, std::move(scene.mapping)};
  }
  Scene scene = particle_scene(*std::get<ParticlesContent>(content).particles, state, rig);
  return {scene.camera, std::move(scene.mapping)};
}

std::array<float, 3> point_at_depth(const OrbitedScene& scene, const PlaceInView& place, float depth) {
  const float shift_px = place.view.eye_separations() * parallax_px(scene.mapping, depth);
  return wheatstone::point_at(scene.camera, static_cast<float>(place.x) - shift_px, static_cast<float>(place.y), depth);
}

std::optional<SeenPoint> point_at(const Viewer& viewer, const PlaceInView& place) {
  const Content& content = content_of(viewer);
  const ViewState& state = viewer.session().state;
  if (const auto* const particles = std::get_if<ParticlesContent>(&content))
    return particle_at(*particles->particles, particle_scene(*particles->particles, state, eyes_of(viewer)), place);
  const Frame* const frame = viewer.frame();
  if (frame == nullptr || !frame->model_depth || frame->shown != content) return {};
  const auto view = std::ranges::find(frame->model_views, place.view);
  if (view == frame->model_views.end()) return {};
  const Image<float>& depths = (*frame->model_depth)[static_cast<std::size_t>(view - frame->model_views.begin())];
  const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
  if (!depths.contains(x, y) || std::isnan(depths(x, y))) return {};
  const OrbitedScene scene = orbited_scene(content, state, eyes_of(viewer));
  return SeenPoint{point_at_depth(scene, place, depths(x, y)), parallax_px(scene.mapping, depths(x, y))};
}

std::array<float, 3> moved_look_at(const Content& content, const ViewState& state, const Rig& rig, double x_px,
                                   double y_px) {
  const std::array<float, 3> middle = state.orbit.look_at.value_or(orbited(content)->middle);
  const Camera camera = orbited_scene(content, state, rig).camera;
  std::array<float, 3> moved{}, from_camera{};
  for (std::size_t axis = 0; axis < 3; ++axis) from_camera[axis] = middle[axis] - camera.position[axis];
  const float depth = std::inner_product(from_camera.begin(), from_camera.end(), camera.forward.begin(), 0.f);
  const float units_a_pixel = 1 / (camera.focal_px * camera.nearness(depth));
  for (std::size_t axis = 0; axis < 3; ++axis)
    moved[axis] = middle[axis] - units_a_pixel * (static_cast<float>(x_px) * camera.right[axis] +
                                                  static_cast<float>(y_px) * camera.down[axis]);
  return moved;
}

Rig eyes_of(const Viewer& viewer) {
  const ViewState& state = viewer.session().state;
  const PictureSize eye = eye_size(find_output_mode(state.mode), viewer.viewport());
  const EyePositions positions = eye_positions(state);
  return {std::max(eye.width, 1), std::max(eye.height, 1), {positions.left, positions.right}};
}

bool turns_around(const Viewer& viewer) { return orbited(content_of(viewer)).has_value(); }

bool pan_orbit(Viewer& viewer, double x_px, double y_px) {
  if (!turns_around(viewer)) return false;
  ViewState& state = viewer.session().state;
  state.orbit.look_at = moved_look_at(content_of(viewer), state, eyes_of(viewer), x_px, y_px);
  return true;
}

bool magnify_orbit(Viewer& viewer, double factor, double x_px, double y_px) {
  if (!turns_around(viewer)) return false;
  float& zoom = viewer.session().state.orbit.zoom;
  const float before = zoom;
  zoom = std::clamp(before * static_cast<float>(factor), least_zoom, most_zoom);
  const double magnified = zoom / before;
  return (x_px == 0 && y_px == 0) || pan_orbit(viewer, x_px * (1 - magnified), y_px * (1 - magnified));
}

bool fit_orbit(Viewer& viewer) {
  if (!turns_around(viewer)) return false;
  wheatstone::Framing& orbit = viewer.session().state.orbit;
  orbit.zoom = ViewState().orbit.zoom;
  orbit.look_at.reset();
  return true;
}

}  // namespace wheatstone::viewer
