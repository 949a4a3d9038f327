#include "wheatstone/stereo/synthetic_still.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "wheatstone/error.h"
#include "wheatstone/stereo/synthetic_still_internal.h"

namespace wheatstone {
namespace still {
namespace {

constexpr int tile_px = 16;
/// Nearer by this share of the depth hides a point; less is rounding.
constexpr float least_depth_step = 2e-4f;

/// Parallel cameras in a row, their pictures shifted so that the wall and the nearest point get the disparities asked
/// for: disparity = focal · baseline / depth − shift, and x(v) = x(0) − v · disparity.
struct Cameras {
  int width, height;
  float focal_px, baseline, shift_px;
  Vec3 down, forward;  ///< of the picture; to the right is x

  Ray ray(float x, float y, float view) const {
    const float u = (x - 0.5f * static_cast<float>(width) - view * shift_px) / focal_px;
    const float w = (y - 0.5f * static_cast<float>(height)) / focal_px;
    return {cyclopean_eye + Vec3{view * baseline, 0, 0}, Vec3{u, 0, 0} + down * w + forward};
  }
  /// Of a point at that many lengths of a ray's direction, which are depths.
  float disparity(float depth) const { return focal_px * baseline / depth - shift_px; }
};

Cameras make_cameras(const SyntheticStillOptions& options) {
  Cameras c{};
  c.width = options.width;
  c.height = options.height;
  c.focal_px = 0.5f * static_cast<float>(c.height) / half_height_of_view;
  const float sine = std::sin(camera_pitch_rad), cosine = std::cos(camera_pitch_rad);
  c.down = {0, -cosine, -sine};
  c.forward = {0, -sine, cosine};
  const float unit = static_cast<float>(c.width) / 640;
  const float largest = options.largest_disparity_px.value_or(45 * unit);
  const float least = options.least_disparity_px.value_or(std::min(6 * unit, largest));
  // The table at the picture's lower edge is nearest; the wall behind the table's far edge is farthest.
  const float nearest = cyclopean_eye.y / (sine + half_height_of_view * cosine), farthest = wall_z / cosine;
  const float product = (largest - least) / (1 / nearest - 1 / farthest);
  c.baseline = product / c.focal_px;
  c.shift_px = product / farthest - least + (options.converged ? 0.5f * (largest + least) : 0);
  return c;
}

void check(const SyntheticStillOptions& options) {
  constexpr int least_px = 16, most_px = 16384;
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::wrong_usage, what); };
  if (options.width < least_px || options.height < least_px || options.width > most_px || options.height > most_px)
    refuse(fmt::format("still life of {}x{} pixels, expected {} to {} a side", options.width, options.height, least_px,
                       most_px));
  constexpr int most_aspect = 8;
  if (options.width > most_aspect * options.height || options.height > most_aspect * options.width)
    refuse(fmt::format("still life of {}x{} pixels, expected sides of at most 1:{}", options.width, options.height,
                       most_aspect));
  if (options.samples_a_side < 1 || options.samples_a_side > 8)
    refuse(fmt::format("{} samples a side of a pixel, expected 1 to 8", options.samples_a_side));
  const float least = options.least_disparity_px.value_or(0), largest = options.largest_disparity_px.value_or(least);
  const auto width = static_cast<float>(options.width);
  if (!std::isfinite(least) || !std::isfinite(largest) || largest < least || largest > width || least < -width)
    refuse(fmt::format("disparities from {} to {} px, expected least <= largest within the picture's width", least,
                       largest));
}

/// One eye's view of the scene: which objects may be met in which tile of its picture.
class View {
 public:
  View(const Scene& scene, const Cameras& cameras, float position)
      : scene_(&scene),
        cameras_(&cameras),
        position_(position),
        columns_((cameras.width + tile_px - 1) / tile_px),
        rows_((cameras.height + tile_px - 1) / tile_px),
        tiles_(static_cast<std::size_t>(columns_) * rows_) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) enter(static_cast<int>(i));
  }

  float position() const { return position_; }

  Hit look(float x, float y) const {
    const int column = std::clamp(static_cast<int>(x) / tile_px, 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(y) / tile_px, 0, rows_ - 1);
    const Ray ray = cameras_->ray(x, y, position_);
    Hit hit{std::numeric_limits<float>::max()};
    for (const int object : tiles_[static_cast<std::size_t>(row) * columns_ + column])
      if (find_hit(scene_->objects[object], ray, hit)) hit.object = object;
    return hit;
  }

 private:
  /// Puts an object into the tiles that its bounding sphere may touch: seen within the cone about the sphere.
  void enter(int object) {
    const Object& o = scene_->objects[object];
    const Vec3 to = o.bound_centre - (cyclopean_eye + Vec3{position_ * cameras_->baseline, 0, 0});
    const float depth = dot(to, cameras_->forward), r = o.bound_radius;
    float left = 0, right = static_cast<float>(cameras_->width), top = 0, bottom = static_cast<float>(cameras_->height);
    if (depth > 1.5f * r) {
      const float x = 0.5f * right + position_ * cameras_->shift_px + cameras_->focal_px * to.x / depth;
      const float y = 0.5f * bottom + cameras_->focal_px * dot(to, cameras_->down) / depth;
      const float off_axis = std::max(std::abs(to.x), std::abs(dot(to, cameras_->down))) / depth;
      const float reach = cameras_->focal_px * r * (1 + off_axis) / (depth - r) + 1;
      left = x - reach, right = x + reach, top = y - reach, bottom = y + reach;
    }
    const auto tile = [](float v) { return static_cast<int>(std::floor(std::clamp(v, -1e6f, 1e6f) / tile_px)); };
    for (int row = std::max(tile(top), 0); row <= std::min(tile(bottom), rows_ - 1); ++row)
      for (int column = std::max(tile(left), 0); column <= std::min(tile(right), columns_ - 1); ++column)
        tiles_[static_cast<std::size_t>(row) * columns_ + column].push_back(object);
  }

  const Scene* scene_;
  const Cameras* cameras_;
  float position_;
  int columns_, rows_;
  std::vector<std::vector<int>> tiles_;
};

std::uint8_t srgb_encoded(float linear) {
  const float v = clamp01(linear);
  const float encoded = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(encoded * 255));
}

/// Gathers the samples of one pixel.
struct PixelSamples {
  const Scene& scene;
  const Cameras& cameras;
  const View& view;
  Vec3 sum{};
  int count = 0;
  int first_object = -1;
  bool one_object = true;  ///< all samples so far met the same
  Illumination light{};    ///< varies slowly: worked out once for every object in the pixel
  int lit_object = -1;

  void add(float x, float y) {
    const Hit hit = view.look(x, y);
    if (count++ == 0) first_object = hit.object;
    one_object = one_object && hit.object == first_object;
    if (hit.object < 0) return;
    const Object& object = scene.objects[hit.object];
    const Ray ray = cameras.ray(x, y, view.position());
    const Vec3 point = ray.origin + ray.direction * hit.distance, local = object.pose.point_in(point);
    const Vec3 normal = normal_at(object, local, hit.part);
    if (hit.object != lit_object) {
      light = illumination_at(scene, point, object.pose.direction_out(normal), scene.groups[hit.object]);
      lit_object = hit.object;
    }
    const Finish finish = finish_at(object.surface, local, normal, hit.distance / cameras.focal_px);
    sum += shade(finish, point, object.pose.direction_out(finish.normal), light);
  }
};

/// The mean of a pixel's samples, which stand on a sheared grid: each has its own row and column. Where those on the
/// diagonal meet the same object they are enough.
Rgb8 render_pixel(const Scene& scene, const Cameras& cameras, const View& view, int x, int y, int samples) {
  PixelSamples pixel{scene, cameras, view};
  const float share = 1 / static_cast<float>(samples);
  const auto add = [&](int column, int row) {
    const auto along = [&](int cell, int other) {
      return (static_cast<float>(cell) + (static_cast<float>(other) + 0.5f) * share) * share;
    };
    pixel.add(static_cast<float>(x) + along(column, row), static_cast<float>(y) + along(row, samples - 1 - column));
  };
  for (int i = 0; i < samples; ++i) add(i, i);
  for (int i = 0; i < samples * samples && !pixel.one_object; ++i)
    if (i % samples != i / samples) add(i % samples, i / samples);
  const Vec3 mean = pixel.sum * (1 / static_cast<float>(pixel.count));
  return {srgb_encoded(mean.x), srgb_encoded(mean.y), srgb_encoded(mean.z)};
}

/// True where the point at a pixel's centre is hidden from another view or lies outside its picture.
bool is_occluded(const Cameras& cameras, const View& from, const View& to, float x, float y, float disparity) {
  const float there = x - (to.position() - from.position()) * disparity;
  if (!(there >= 0 && there < static_cast<float>(cameras.width))) return true;
  const float depth = cameras.focal_px * cameras.baseline / (disparity + cameras.shift_px);
  return to.look(there, y).distance < depth * (1 - least_depth_step);
}

void render(const Scene& scene, const Cameras& cameras, const View& view, int samples, Image<Rgb8>& picture,
            Image<float>& disparity) {
  picture = Image<Rgb8>(cameras.width, cameras.height);
  disparity = Image<float>(cameras.width, cameras.height);
  tbb::parallel_for(0, cameras.height, [&](int y) {
    for (int x = 0; x < cameras.width; ++x) {
      picture(x, y) = render_pixel(scene, cameras, view, x, y, samples);
      const Hit hit = view.look(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      disparity(x, y) = hit.object < 0 ? std::numeric_limits<float>::quiet_NaN() : cameras.disparity(hit.distance);
    }
  });
}

Image<std::uint8_t> occlusion_of(const Cameras& cameras, const View& from, const View& to,
                                 const Image<float>& disparity) {
  Image<std::uint8_t> mask(cameras.width, cameras.height);
  tbb::parallel_for(0, cameras.height, [&](int y) {
    for (int x = 0; x < cameras.width; ++x) {
      const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
      mask(x, y) = is_occluded(cameras, from, to, px, py, disparity(x, y)) ? 255 : 0;
    }
  });
  return mask;
}

}  // namespace
}  // namespace still

SyntheticStill make_synthetic_still(const SyntheticStillOptions& options) {
  still::check(options);
  const still::Scene scene = still::compose_still(options.seed);
  const still::Cameras cameras = still::make_cameras(options);
  const still::View left(scene, cameras, -0.5f), right(scene, cameras, 0.5f);
  SyntheticStill result;
  still::render(scene, cameras, left, options.samples_a_side, result.pictures.left, result.geometry.left_disparity);
  still::render(scene, cameras, right, options.samples_a_side, result.pictures.right, result.geometry.right_disparity);
  result.geometry.left_occlusion = still::occlusion_of(cameras, left, right, result.geometry.left_disparity);
  result.geometry.right_occlusion = still::occlusion_of(cameras, right, left, result.geometry.right_disparity);
  return result;
}

SyntheticView make_synthetic_view(const SyntheticStillOptions& options, float view) {
  still::check(options);
  const still::Scene scene = still::compose_still(options.seed);
  const still::Cameras cameras = still::make_cameras(options);
  SyntheticView result;
  still::render(scene, cameras, still::View(scene, cameras, view), options.samples_a_side, result.picture,
                result.disparity);
  return result;
}

}  // namespace wheatstone
