// The cameras' way through the still life: rays, samples, pixels.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "wheatstone/synthetic/synthetic_still_view_internal.h"

namespace wheatstone::still {
namespace {

/// Sixteen pixels, and fewer in small pictures, where they would hold most of the scene.
int tile_size(const Cameras& cameras) { return std::clamp(cameras.width / 64, 2, 16); }

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
    const bool moved = !scene.lit_poses.empty();
    const Pose& lit = moved ? scene.lit_poses[hit.object] : object.pose;
    const Vec3 lit_point = moved ? lit.origin + lit.direction_out(local) : point;
    if (hit.object != lit_object) {
      light = illumination_at(scene, lit_point, lit.direction_out(normal), scene.groups[hit.object]);
      lit_object = hit.object;
    }
    const Finish finish = finish_at(object.surface, local, normal, hit.distance / cameras.focal_px);
    sum += shade(finish, lit_point, lit.direction_out(finish.normal), light);
  }
};

Rgb8 encoded_mean(Vec3 sum, int count) {
  const Vec3 mean = sum * (1 / static_cast<float>(count));
  return {srgb_encoded(mean.x), srgb_encoded(mean.y), srgb_encoded(mean.z)};
}

/// The mean of a pixel's samples, which stand on a sheared grid: each has its own row and column. Where those on the
/// diagonal meet the same object they are enough.
Rgb8 render_pixel(const View& view, int x, int y, int samples) {
  PixelSamples pixel{view.scene(), view.cameras(), view};
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
  return encoded_mean(pixel.sum, pixel.count);
}

/// The mean of a pixel's samples, which the moments of an exposure take in turn.
Rgb8 render_moving_pixel(std::span<const View> moments, int x, int y, int samples) {
  const auto count = static_cast<int>(moments.size());
  while (samples * samples < count) ++samples;
  const float share = 1 / static_cast<float>(samples);
  Vec3 sum;
  for (int moment = 0; moment < count; ++moment) {
    const View& view = moments[moment];
    PixelSamples pixel{view.scene(), view.cameras(), view};
    for (int i = moment; i < samples * samples; i += count) {
      const int column = i % samples, row = i / samples;
      pixel.add(static_cast<float>(x) + (static_cast<float>(column) + 0.5f) * share,
                static_cast<float>(y) + (static_cast<float>(row) + 0.5f) * share);
    }
    sum += pixel.sum;
  }
  return encoded_mean(sum, samples * samples);
}

Image<float> disparity_of(const View& view) {
  const Cameras& cameras = view.cameras();
  Image<float> disparity(cameras.width, cameras.height);
  tbb::parallel_for(0, cameras.height, [&](int y) {
    for (int x = 0; x < cameras.width; ++x) {
      const Hit hit = view.look(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      disparity(x, y) = hit.object < 0 ? std::numeric_limits<float>::quiet_NaN() : cameras.disparity(hit.distance);
    }
  });
  return disparity;
}

}  // namespace

View::View(const Scene& scene, const Cameras& cameras, ViewPosition position)
    : scene_(&scene),
      cameras_(&cameras),
      position_(position),
      tile_px_(tile_size(cameras)),
      columns_((cameras.width + tile_px_ - 1) / tile_px_),
      rows_((cameras.height + tile_px_ - 1) / tile_px_),
      tiles_(static_cast<std::size_t>(columns_) * rows_) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) enter(static_cast<int>(i));
}

Hit View::look(float x, float y) const {
  const int column = std::clamp(static_cast<int>(x) / tile_px_, 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(y) / tile_px_, 0, rows_ - 1);
  const Ray ray = cameras_->ray(x, y, position_);
  Hit hit{std::numeric_limits<float>::max()};
  for (const int object : tiles_[static_cast<std::size_t>(row) * columns_ + column])
    if (find_hit(scene_->objects[object], ray, hit)) hit.object = object;
  return hit;
}

bool View::is_hidden(float x, float y, float depth) const {
  if (!(x >= 0 && x < static_cast<float>(cameras_->width))) return true;
  if (!(y >= 0 && y < static_cast<float>(cameras_->height))) return true;
  return look(x, y).distance < depth * (1 - least_depth_step);
}

/// Puts an object into the tiles that its bounding sphere may touch: seen within the cone about the sphere.
void View::enter(int object) {
  const Object& o = scene_->objects[object];
  const Vec3 to = o.bound_centre - cameras_->eye_of(position_);
  const float depth = dot(to, cameras_->forward), aside = dot(to, cameras_->right), r = o.bound_radius;
  float left = 0, right = static_cast<float>(cameras_->width), top = 0, bottom = static_cast<float>(cameras_->height);
  if (depth > 1.5f * r) {
    const float x = 0.5f * right + (position_ - central_view) * cameras_->shift_px + cameras_->focal_px * aside / depth;
    const float y = 0.5f * bottom + cameras_->focal_px * dot(to, cameras_->down) / depth;
    const float off_axis = std::max(std::abs(aside), std::abs(dot(to, cameras_->down))) / depth;
    const float reach = cameras_->focal_px * r * (1 + off_axis) / (depth - r) + 1;
    left = x - reach, right = x + reach, top = y - reach, bottom = y + reach;
  }
  const auto tile = [&](float v) {
    return static_cast<int>(std::floor(std::clamp(v, -1e6f, 1e6f) / static_cast<float>(tile_px_)));
  };
  for (int row = std::max(tile(top), 0); row <= std::min(tile(bottom), rows_ - 1); ++row)
    for (int column = std::max(tile(left), 0); column <= std::min(tile(right), columns_ - 1); ++column)
      tiles_[static_cast<std::size_t>(row) * columns_ + column].push_back(object);
}

SyntheticView render(const View& view, int samples_a_side, const Progress& progress) {
  const Cameras& cameras = view.cameras();
  SyntheticView result{Image<Rgb8>(cameras.width, cameras.height), disparity_of(view)};
  const auto cast_row = [&](int y) {
    for (int x = 0; x < cameras.width; ++x) result.picture(x, y) = render_pixel(view, x, y, samples_a_side);
  };
  const int rows_at_once = std::max(64, cameras.height / 32);
  for (int first = 0; first < cameras.height; first += rows_at_once) {
    report(progress, "casting rays", static_cast<double>(first) / cameras.height);
    tbb::parallel_for(first, std::min(first + rows_at_once, cameras.height), cast_row);
  }
  return result;
}

SyntheticView render_exposure(std::span<const View> moments, int samples_a_side) {
  const View& middle = moments[moments.size() / 2];
  const Cameras& cameras = middle.cameras();
  SyntheticView result{Image<Rgb8>(cameras.width, cameras.height), disparity_of(middle)};
  tbb::parallel_for(0, cameras.height, [&](int y) {
    for (int x = 0; x < cameras.width; ++x) result.picture(x, y) = render_moving_pixel(moments, x, y, samples_a_side);
  });
  return result;
}

Image<std::uint8_t> occlusion_of(const Cameras& cameras, const View& from, const View& to,
                                 const Image<float>& disparity) {
  Image<std::uint8_t> mask(cameras.width, cameras.height);
  tbb::parallel_for(0, cameras.height, [&](int y) {
    for (int x = 0; x < cameras.width; ++x) {
      const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f, d = disparity(x, y);
      const float there = px - (to.position() - from.position()) * d;
      const float depth = cameras.focal_px * cameras.baseline / (d + cameras.shift_px);
      mask(x, y) = to.is_hidden(there, py, depth) ? 255 : 0;
    }
  });
  return mask;
}

}  // namespace wheatstone::still
