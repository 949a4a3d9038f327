#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "wheatstone/synthetic/synthetic_film_shot_internal.h"

namespace wheatstone::still {
namespace {

/// A sine of that many frames a wave.
float wave(float time, float frames, float phase = 0) {
  return std::sin(2 * std::numbers::pi_v<float> * (time / frames + phase));
}

bool lies_in_vessel(const Scene& scene, Vec3 point) {
  return std::ranges::any_of(scene.mouths, [&](const Mouth& mouth) {
    return std::hypot(point.x - mouth.centre.x, point.z - mouth.centre.z) < mouth.radius;
  });
}

bool is_fruit(const Object& object) {
  const Material material = object.surface.material;
  return material == Material::apple || material == Material::pear || material == Material::lemon;
}

/// What moves with an object, from it on.
std::vector<int> group_from(const Scene& scene, std::size_t first) {
  std::vector<int> objects;
  for (std::size_t i = first; i < scene.objects.size() && scene.groups[i] == scene.groups[first]; ++i)
    objects.push_back(static_cast<int>(i));
  return objects;
}

/// The apples, pears and lemons beside the bowl, with their stalks.
std::vector<Mover> find_fruit(const Scene& scene) {
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!is_fruit(object) || lies_in_vessel(scene, object.pose.origin)) continue;
    movers.push_back({group_from(scene, i), object.bound_centre, 0.37f * static_cast<float>(movers.size())});
  }
  return movers;
}

/// All but the room.
std::vector<Mover> find_figures(const Scene& scene, std::uint64_t seed) {
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < scene.objects.size();) {
    std::vector<int> objects = group_from(scene, i);
    const Object& object = scene.objects[i];
    i += objects.size();
    if (std::holds_alternative<Panel>(object.shape)) continue;
    const auto number = static_cast<std::uint32_t>(movers.size());
    movers.push_back({std::move(objects), object.bound_centre,
                      unit_of(lattice_hash(number, 7, 1, static_cast<std::uint32_t>(seed)))});
  }
  return movers;
}

Vec3 turned_about_y(Vec3 v, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

void move(const Mover& mover, float turn, Vec3 shift, Scene& scene) {
  for (const int index : mover.objects) {
    Object& object = scene.objects[index];
    object.pose.origin = mover.pivot + turned_about_y(object.pose.origin - mover.pivot, turn) + shift;
    for (Vec3& axis : object.pose.axes) axis = turned_about_y(axis, turn);
    set_bounds(object);
  }
}

void hop_about(const Mover& mover, float time, Scene& scene) {
  const float hop = 0.030f * (1 - wave(time, 28, mover.phase + 0.25f));
  const Vec3 shift{0.022f * wave(time, 36, mover.phase), hop, 0.012f * wave(time, 44, mover.phase)};
  move(mover, 0.03f * time, shift, scene);
}

/// Figures walk straight on, every other one to the left. One that has left the picture comes back on its other side.
void walk_across(const Mover& mover, const SyntheticStillOptions& still, float time, Scene& scene) {
  const float aspect = static_cast<float>(still.width) / static_cast<float>(still.height);
  const float room = 0.12f;  // beside the picture, wider than a figure and its step
  const float half_width = (mover.pivot.z + 0.12f) * half_height_of_view * aspect + room;
  const float way = mover.objects.front() % 4 < 2 ? 1.f : -1.f;  // a figure has two objects
  const float step = way * (0.004f + 0.009f * std::fmod(mover.phase * 7, 1.f));
  const float turns = (mover.phase * 2 * half_width + step * time) / (2 * half_width);
  const float x = half_width * (2 * (turns - std::floor(turns)) - 1);
  const float bob = 0.003f * (1 - wave(time, 11, mover.phase));
  move(mover, 0, {x - mover.pivot.x, bob, 0}, scene);
}

}  // namespace

Shot make_shot(const SyntheticFilmOptions& options, std::uint64_t seed) {
  Shot shot;
  Scene& scene = shot.scene;
  scene = options.scene == FilmScene::beams   ? compose_beams(seed)
          : options.scene == FilmScene::crowd ? compose_crowd(seed)
                                              : compose_still(seed);
  for (const Object& object : scene.objects) scene.lit_poses.push_back(object.pose);
  if (options.scene == FilmScene::crowd) shot.movers = find_figures(scene, seed);
  if (options.scene != FilmScene::still_life || options.motion == FilmMotion::pan) return shot;
  shot.movers = find_fruit(scene);
  std::erase_if(scene.casters, [&](const ShadowCaster& caster) {
    return std::ranges::any_of(shot.movers,
                               [&](const Mover& mover) { return scene.groups[mover.objects[0]] == caster.group; });
  });
  scene.reach = reach_of(scene.casters);
  return shot;
}

Scene scene_at(const Shot& shot, const SyntheticFilmOptions& options, float time) {
  Scene scene = shot.scene;
  for (const Mover& mover : shot.movers) {
    if (options.scene == FilmScene::crowd) {
      walk_across(mover, options.still, time, scene);
    } else {
      hop_about(mover, time, scene);
    }
  }
  return scene;
}

Cameras cameras_at(const SyntheticFilmOptions& options, float time) {
  Cameras cameras = make_cameras(options.still);
  float yaw = 0;
  if (options.scene == FilmScene::beams) {
    cameras.eye += {0.46f * wave(time, 160), 0, 0};
    yaw = 0.20f * wave(time, 160);
  } else if (options.scene != FilmScene::still_life) {
    return cameras;
  } else if (options.motion == FilmMotion::pan) {
    yaw = 0.10f * wave(time, 800);
  } else {
    cameras.eye += {0.07f * wave(time, 110), 0.012f * wave(time, 60), 0.06f * wave(time, 130)};
    yaw = 0.025f * wave(time, 90, 0.1f);
  }
  cameras.right = turned_about_y(cameras.right, yaw);
  cameras.down = turned_about_y(cameras.down, yaw);
  cameras.forward = turned_about_y(cameras.forward, yaw);
  return cameras;
}

std::vector<float> exposure_of(const SyntheticFilmOptions& options) {
  if (options.scene != FilmScene::beams) return {0};
  constexpr int moments = 9;
  constexpr float open = 0.5f;  // of the time of a frame
  std::vector<float> times;
  for (int i = 0; i < moments; ++i)
    times.push_back(open * ((static_cast<float>(i) + 0.5f) / static_cast<float>(moments) - 0.5f));
  return times;
}

}  // namespace wheatstone::still
