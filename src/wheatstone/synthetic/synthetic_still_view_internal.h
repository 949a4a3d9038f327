#pragma once

// How the still life is looked at: cameras, what each of them meets, and the pictures that they take.

#include <span>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/progress.h"
#include "wheatstone/synthetic/synthetic_still.h"
#include "wheatstone/synthetic/synthetic_still_internal.h"

namespace wheatstone::still {

/// Nearer by this share of the depth hides a point; less is rounding.
inline constexpr float least_depth_step = 2e-4f;

/// Parallel cameras in a row, their pictures shifted so that the wall and the nearest point get the disparities asked
/// for: disparity = focal · baseline / depth − shift, and x(v) = x(0) − v · disparity.
struct Cameras {
  int width, height;
  float focal_px, baseline, shift_px;
  Vec3 down, forward;  ///< of the picture
  Vec3 right{1, 0, 0};
  Vec3 eye = cyclopean_eye;  ///< of the central view

  Vec3 eye_of(ViewPosition view) const { return eye + right * ((view - central_view) * baseline); }
  Ray ray(float x, float y, ViewPosition view) const {
    const float u = (x - 0.5f * static_cast<float>(width) - (view - central_view) * shift_px) / focal_px;
    const float w = (y - 0.5f * static_cast<float>(height)) / focal_px;
    return {eye_of(view), right * u + down * w + forward};
  }
  /// Of a point at that many lengths of a ray's direction, which are depths.
  float disparity(float depth) const { return focal_px * baseline / depth - shift_px; }

  /// Where a point is seen. Points behind the camera have negative depths.
  struct Sight {
    float x, y, depth;
  };
  Sight sight(Vec3 point, ViewPosition view) const {
    const Vec3 to = point - eye_of(view);
    const float depth = dot(to, forward), scale = focal_px / depth;
    return {0.5f * static_cast<float>(width) + (view - central_view) * shift_px + scale * dot(to, right),
            0.5f * static_cast<float>(height) + scale * dot(to, down), depth};
  }
};

/// The still life's own cameras. Throws Error{wrong_usage} for sizes or ranges that make no sense.
Cameras make_cameras(const SyntheticStillOptions& options);

/// One eye's view of the scene: which objects may be met in which tile of its picture. Borrows both.
class View {
 public:
  View(const Scene& scene, const Cameras& cameras, ViewPosition position);

  const Scene& scene() const { return *scene_; }
  const Cameras& cameras() const { return *cameras_; }
  ViewPosition position() const { return position_; }
  /// What the ray through a place of the picture meets first; object −1 where there is nothing.
  Hit look(float x, float y) const;
  /// True where the point seen at (x, y) in that depth is hidden behind something, or (x, y) is outside the picture.
  bool is_hidden(float x, float y, float depth) const;

 private:
  void enter(int object);

  const Scene* scene_;
  const Cameras* cameras_;
  ViewPosition position_;
  int tile_px_, columns_, rows_;
  std::vector<std::vector<int>> tiles_;
};

/// A view's picture, each pixel the mean of samples_a_side² samples, and its exact disparity; NaN where nothing is.
SyntheticView render(const View& view, int samples_a_side, const Progress& progress = {});

/// The picture of an exposure during which things move: the views are its moments, of one size, and share a pixel's
/// samples. The disparity is that of the moment in the middle.
SyntheticView render_exposure(std::span<const View> moments, int samples_a_side);

/// 255 where the point at a pixel's centre is hidden from another view of the same frame or outside its picture.
Image<std::uint8_t> occlusion_of(const Cameras& cameras, const View& from, const View& to,
                                 const Image<float>& disparity);

}  // namespace wheatstone::still
