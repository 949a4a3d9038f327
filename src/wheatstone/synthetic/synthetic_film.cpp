#include "wheatstone/synthetic/synthetic_film.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/random.h"
#include "wheatstone/synthetic/synthetic_film_shot_internal.h"

namespace wheatstone {
namespace {

using still::Cameras, still::Pose, still::Scene, still::Shot, still::Vec3, still::View;

/// A frame as the left eye sees it, for looking up where points went. Not to be moved: the view borrows the rest.
struct Moment {
  Scene scene;
  Cameras cameras;
  View left;

  /// At a time in frames from the shot's first.
  Moment(const Shot& shot, const SyntheticFilmOptions& options, float time)
      : scene(scene_at(shot, options, time)),
        cameras(still::cameras_at(options, time)),
        left(scene, cameras, left_eye) {}
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;
};

/// A frame into which points are followed, and what comes of it.
struct Neighbour {
  const Moment* frame;
  Flow* flow;
  Image<std::uint8_t>* occlusion;
};

/// Follows the point at every pixel's centre into other frames.
void find_flow(const Moment& from, const std::vector<Neighbour>& neighbours) {
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

/// Both eyes' pictures, during an exposure whose moments are these.
void expose(const std::deque<Moment>& moments, int samples, SyntheticFilmFrame& result) {
  std::vector<View> left, right;
  for (const Moment& moment : moments) {
    left.push_back(moment.left);
    right.emplace_back(moment.scene, moment.cameras, right_eye);
  }
  const auto render = [&](const std::vector<View>& views) {
    return views.size() == 1 ? still::render(views.front(), samples) : still::render_exposure(views, samples);
  };
  const std::size_t middle = moments.size() / 2;
  const Cameras& cameras = moments[middle].cameras;
  SyntheticView of_left = render(left), of_right = render(right);
  result.geometry.left_occlusion = still::occlusion_of(cameras, left[middle], right[middle], of_left.disparity);
  result.geometry.right_occlusion = still::occlusion_of(cameras, right[middle], left[middle], of_right.disparity);
  result.geometry.left_disparity = std::move(of_left.disparity);
  result.geometry.right_disparity = std::move(of_right.disparity);
  result.pictures = {std::move(of_left.picture), std::move(of_right.picture)};
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

float noise_of(const SyntheticFilmOptions& options) {
  return options.noise.value_or(options.scene == FilmScene::still ? 3.f : 0.f);
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
  const int cut = options.cut.value_or(options.scene == FilmScene::still_life ? options.frames / 2 : 0);
  if (cut < 0 || cut >= options.frames)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("cut at frame {}, expected one of {} frames, or 0 for none", cut, options.frames));
  constexpr float most_noise = 255;
  const float noise = noise_of(options);
  if (!(noise >= 0 && noise <= most_noise))
    throw Error(ErrorKind::wrong_usage, fmt::format("noise of {}, expected 0 to {}", noise, most_noise));
  return cut;
}

SyntheticFilmFrame make_synthetic_film_frame(const SyntheticFilmOptions& options, int frame) {
  const int cut = cut_of(options);
  if (frame < 0 || frame >= options.frames)
    throw Error(ErrorKind::wrong_usage, fmt::format("frame {} of a film of {}", frame, options.frames));
  const bool second = cut > 0 && frame >= cut;
  const int first_of_shot = second ? cut : 0, end_of_shot = second || cut == 0 ? options.frames : cut;
  const Shot shot = still::make_shot(options, options.still.seed + (second ? 1 : 0));
  const auto time_of = [&](int in_film) { return static_cast<float>(in_film - first_of_shot); };
  std::deque<Moment> moments;
  for (const float moment : still::exposure_of(options)) moments.emplace_back(shot, options, time_of(frame) + moment);
  const Moment& now = moments[moments.size() / 2];
  const int width = now.cameras.width, height = now.cameras.height;
  SyntheticFilmFrame result;
  expose(moments, options.still.samples_a_side, result);

  std::optional<Moment> next, previous;
  std::vector<Neighbour> neighbours;
  const auto follow = [&](int other, std::optional<Moment>& in, Flow& flow, Image<std::uint8_t>& occlusion) {
    flow = unknown_flow(width, height);
    occlusion = Image<std::uint8_t>(width, height, 255);
    if (other < first_of_shot || other >= end_of_shot) return;
    neighbours.push_back({&in.emplace(shot, options, time_of(other)), &flow, &occlusion});
  };
  follow(frame + 1, next, result.to_next, result.next_occlusion);
  follow(frame - 1, previous, result.to_previous, result.previous_occlusion);
  find_flow(now, neighbours);

  if (const float noise = noise_of(options); noise > 0) {
    const auto key = [&](std::uint64_t eye) {
      return hash_keys({options.still.seed, static_cast<std::uint64_t>(frame), eye});
    };
    add_noise(result.pictures.left, noise, key(0));
    add_noise(result.pictures.right, noise, key(1));
  }
  return result;
}

}  // namespace wheatstone
