#include "wheatstone/synthetic/synthetic_film.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/random.h"
#include "wheatstone/synthetic/synthetic_still_view_internal.h"

namespace wheatstone {
namespace {

using still::Cameras, still::Object, still::Pose, still::Scene, still::Vec3, still::View;

/// A sine of that many frames a wave.
float wave(int frame, float frames, float phase = 0) {
  return std::sin(2 * std::numbers::pi_v<float> * (static_cast<float>(frame) / frames + phase));
}

/// A thing that moves as a whole: its objects, and the point about which they turn.
struct Mover {
  std::vector<int> objects;
  Vec3 pivot;
  float phase = 0;
};

bool lies_in_vessel(const Scene& scene, Vec3 point) {
  return std::ranges::any_of(scene.mouths, [&](const still::Mouth& mouth) {
    return std::hypot(point.x - mouth.centre.x, point.z - mouth.centre.z) < mouth.radius;
  });
}

bool is_fruit(const Object& object) {
  const still::Material material = object.surface.material;
  return material == still::Material::apple || material == still::Material::pear || material == still::Material::lemon;
}

/// The apples, pears and lemons beside the bowl, with their stalks.
std::vector<Mover> find_movers(const Scene& scene) {
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!is_fruit(object) || lies_in_vessel(scene, object.pose.origin)) continue;
    Mover mover{{}, object.bound_centre, 0.37f * static_cast<float>(movers.size())};
    for (std::size_t k = i; k < scene.objects.size() && scene.groups[k] == scene.groups[i]; ++k)
      mover.objects.push_back(static_cast<int>(k));
    movers.push_back(std::move(mover));
  }
  return movers;
}

/// A scene of the film at rest, lit; things that may move cast no shadow, which would stay behind.
struct Shot {
  Scene scene;
  std::vector<Mover> movers;
};

Shot make_shot(std::uint64_t seed, FilmMotion motion) {
  Shot shot{still::compose_still(seed), {}};
  Scene& scene = shot.scene;
  for (const Object& object : scene.objects) scene.lit_poses.push_back(object.pose);
  if (motion == FilmMotion::pan) return shot;
  shot.movers = find_movers(scene);
  std::erase_if(scene.casters, [&](const still::ShadowCaster& caster) {
    return std::ranges::any_of(shot.movers,
                               [&](const Mover& mover) { return scene.groups[mover.objects[0]] == caster.group; });
  });
  scene.reach = still::reach_of(scene.casters);
  return shot;
}

Vec3 turned_about_y(Vec3 v, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

/// The shot with everything where it is in a frame, counted from the shot's first.
Scene scene_at(const Shot& shot, int frame) {
  Scene scene = shot.scene;
  for (const Mover& mover : shot.movers) {
    const float hop = 0.030f * (1 - wave(frame, 28, mover.phase + 0.25f));
    const Vec3 shift{0.022f * wave(frame, 36, mover.phase), hop, 0.012f * wave(frame, 44, mover.phase)};
    const float turn = 0.03f * static_cast<float>(frame);
    for (const int index : mover.objects) {
      Object& object = scene.objects[index];
      object.pose.origin = mover.pivot + turned_about_y(object.pose.origin - mover.pivot, turn) + shift;
      for (Vec3& axis : object.pose.axes) axis = turned_about_y(axis, turn);
      still::set_bounds(object);
    }
  }
  return scene;
}

Cameras cameras_at(const SyntheticFilmOptions& options, int frame) {
  Cameras cameras = still::make_cameras(options.still);
  float yaw = 0;
  if (options.motion == FilmMotion::pan) {
    yaw = 0.10f * wave(frame, 800);
  } else {
    cameras.eye += {0.07f * wave(frame, 110), 0.012f * wave(frame, 60), 0.06f * wave(frame, 130)};
    yaw = 0.025f * wave(frame, 90, 0.1f);
  }
  cameras.right = turned_about_y(cameras.right, yaw);
  cameras.down = turned_about_y(cameras.down, yaw);
  cameras.forward = turned_about_y(cameras.forward, yaw);
  return cameras;
}

/// A frame as the left eye sees it, for looking up where points went. Not to be moved: the view borrows the rest.
struct FilmFrame {
  Scene scene;
  Cameras cameras;
  View left;

  FilmFrame(const Shot& shot, const SyntheticFilmOptions& options, int frame)
      : scene(scene_at(shot, frame)), cameras(cameras_at(options, frame)), left(scene, cameras, left_eye) {}
  FilmFrame(const FilmFrame&) = delete;
  FilmFrame& operator=(const FilmFrame&) = delete;
};

/// A frame into which points are followed, and what comes of it.
struct Neighbour {
  const FilmFrame* frame;
  Flow* flow;
  Image<std::uint8_t>* occlusion;
};

/// Follows the point at every pixel's centre into other frames.
void find_flow(const FilmFrame& from, const std::vector<Neighbour>& neighbours) {
  tbb::parallel_for(0, from.cameras.height, [&](int y) {
    for (int x = 0; x < from.cameras.width; ++x) {
      const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
      const still::Hit hit = from.left.look(px, py);
      if (hit.object < 0) continue;
      const still::Ray ray = from.cameras.ray(px, py, from.left.position());
      const Vec3 local = from.scene.objects[hit.object].pose.point_in(ray.origin + ray.direction * hit.distance);
      for (const auto& [to, flow, occlusion] : neighbours) {
        const Pose& after = to->scene.objects[hit.object].pose;
        const Cameras::Sight sight = to->cameras.sight(after.origin + after.direction_out(local), to->left.position());
        if (sight.depth <= 0) continue;
        flow->x(x, y) = sight.x - px;
        flow->y(x, y) = sight.y - py;
        (*occlusion)(x, y) = to->left.is_hidden(sight.x, sight.y, sight.depth) ? 255 : 0;
      }
    }
  });
}

/// Normally distributed, two at a time (Box and Muller).
std::pair<float, float> normal_pair(std::uint64_t hashed) {
  const float radius = std::sqrt(-2 * std::log(1 - unit_float(hashed)));
  const float angle = 2 * std::numbers::pi_v<float> * unit_float(hash_keys({hashed}));
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

void add_noise(Image<Rgb8>& picture, float deviation, std::uint64_t key) {
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::uint64_t hashed = hash_keys({key, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x)});
      const auto [r, g] = normal_pair(hashed);
      const float b = normal_pair(hash_keys({hashed, 1})).first;
      const auto noisy = [&](std::uint8_t value, float noise) {
        const float sum = static_cast<float>(value) + deviation * noise;
        return static_cast<std::uint8_t>(std::lround(std::clamp(sum, 0.f, 255.f)));
      };
      Rgb8& pixel = picture(x, y);
      pixel = {noisy(pixel.r, r), noisy(pixel.g, g), noisy(pixel.b, b)};
    }
  });
}

Flow unknown_flow(int width, int height) {
  const Image<float> unknown(width, height, std::numeric_limits<float>::quiet_NaN());
  return {unknown, unknown};
}

}  // namespace

int cut_of(const SyntheticFilmOptions& options) {
  constexpr int most_frames = 100'000;
  if (options.frames < 1 || options.frames > most_frames)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("film of {} frames, expected 1 to {}", options.frames, most_frames));
  const int cut = options.cut.value_or(options.frames / 2);
  if (cut < 0 || cut >= options.frames)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("cut at frame {}, expected one of {} frames, or 0 for none", cut, options.frames));
  constexpr float most_noise = 255;
  if (!(options.noise >= 0 && options.noise <= most_noise))
    throw Error(ErrorKind::wrong_usage, fmt::format("noise of {}, expected 0 to {}", options.noise, most_noise));
  return cut;
}

SyntheticFilmFrame make_synthetic_film_frame(const SyntheticFilmOptions& options, int frame) {
  const int cut = cut_of(options);
  if (frame < 0 || frame >= options.frames)
    throw Error(ErrorKind::wrong_usage, fmt::format("frame {} of a film of {}", frame, options.frames));
  const bool second = cut > 0 && frame >= cut;
  const int first_of_shot = second ? cut : 0, end_of_shot = second || cut == 0 ? options.frames : cut;
  const Shot shot = make_shot(options.still.seed + (second ? 1 : 0), options.motion);
  const FilmFrame now(shot, options, frame - first_of_shot);
  const View right(now.scene, now.cameras, right_eye);
  const int samples = options.still.samples_a_side, width = now.cameras.width, height = now.cameras.height;

  SyntheticFilmFrame result;
  SyntheticView of_left = still::render(now.left, samples);
  SyntheticView of_right = still::render(right, samples);
  result.geometry.left_occlusion = still::occlusion_of(now.cameras, now.left, right, of_left.disparity);
  result.geometry.right_occlusion = still::occlusion_of(now.cameras, right, now.left, of_right.disparity);
  result.geometry.left_disparity = std::move(of_left.disparity);
  result.geometry.right_disparity = std::move(of_right.disparity);
  result.pictures = {std::move(of_left.picture), std::move(of_right.picture)};

  std::optional<FilmFrame> next, previous;
  std::vector<Neighbour> neighbours;
  const auto follow = [&](int other, std::optional<FilmFrame>& in, Flow& flow, Image<std::uint8_t>& occlusion) {
    flow = unknown_flow(width, height);
    occlusion = Image<std::uint8_t>(width, height, 255);
    if (other < first_of_shot || other >= end_of_shot) return;
    neighbours.push_back({&in.emplace(shot, options, other - first_of_shot), &flow, &occlusion});
  };
  follow(frame + 1, next, result.to_next, result.next_occlusion);
  follow(frame - 1, previous, result.to_previous, result.previous_occlusion);
  find_flow(now, neighbours);

  if (options.noise > 0) {
    const auto key = [&](std::uint64_t eye) {
      return hash_keys({options.still.seed, static_cast<std::uint64_t>(frame), eye});
    };
    add_noise(result.pictures.left, options.noise, key(0));
    add_noise(result.pictures.right, options.noise, key(1));
  }
  return result;
}

}  // namespace wheatstone
