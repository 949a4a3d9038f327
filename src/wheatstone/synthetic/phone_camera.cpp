#include "wheatstone/synthetic/phone_camera.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/colour.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/random.h"
#include "wheatstone/synthetic/synthetic_still_view_internal.h"

namespace wheatstone {
namespace {

/// Cast around the pictures on each side, as a share of their width and height.
constexpr double margin = 0.08;

/// One camera: places of the scene's picture, whose camera stands straight, and of the photograph that it takes.
class PhoneCamera {
 public:
  /// `axis` is where the scene's picture shows what is straight ahead.
  PhoneCamera(cv::Point2d axis, cv::Size photograph, const PhoneCameraOptions& options, std::uint64_t seed)
      : axis_(axis),
        photograph_(photograph),
        focal_(options.focal_to_width * photograph.width),
        distortion_(options.radial_distortion) {
    cv::Vec3d turn;
    for (int about = 0; about < 3; ++about) {
      const double share =
          2 * static_cast<double>(unit_float(hash_keys({seed, static_cast<std::uint64_t>(about)}))) - 1;
      turn[about] = share * options.most_turn_degrees * std::numbers::pi / 180;
    }
    cv::Rodrigues(turn, to_scene_);
  }

  cv::Point2d photographed(const cv::Point2d& in_scene) const {
    const cv::Vec3d ray =
        to_scene_.t() * cv::Vec3d((in_scene.x - axis_.x) / focal_, (in_scene.y - axis_.y) / focal_, 1);
    const double x = ray[0] / ray[2], y = ray[1] / ray[2];
    const double grown = 1 + distortion_ * (x * x + y * y);
    return {photograph_.width / 2.0 + focal_ * grown * x, photograph_.height / 2.0 + focal_ * grown * y};
  }

  cv::Point2d in_scene(const cv::Point2d& photographed) const {
    const double to_x = (photographed.x - photograph_.width / 2.0) / focal_;
    const double to_y = (photographed.y - photograph_.height / 2.0) / focal_;
    // Converges by a factor of distortion · r² a round.
    constexpr int rounds = 20;
    double x = to_x, y = to_y;
    for (int round = 0; round < rounds; ++round) {
      const double grown = 1 + distortion_ * (x * x + y * y);
      x = to_x / grown;
      y = to_y / grown;
    }
    const cv::Vec3d ray = to_scene_ * cv::Vec3d(x, y, 1);
    return {axis_.x + focal_ * ray[0] / ray[2], axis_.y + focal_ * ray[1] / ray[2]};
  }

 private:
  cv::Point2d axis_;
  cv::Size photograph_;
  double focal_, distortion_;
  cv::Matx33d to_scene_;  ///< of rays
};

/// Nearly normal with variance 1: the sum of twelve uniform numbers (Irwin & Hall).
double normal_number(std::initializer_list<std::uint64_t> keys) {
  std::uint64_t state = hash_keys(keys);
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(unit_float(state = hash_keys({state})));
  return sum;
}

struct Exposure {
  double factor = 1, noise = 0;
  std::uint64_t seed = 0;

  std::uint8_t of(std::uint8_t code, std::uint64_t place) const {
    const double exposed =
        factor == 1 ? code : srgb_from_linear(static_cast<float>(factor * static_cast<double>(linear_from_srgb(code))));
    const double noisy = noise == 0 ? exposed : exposed + noise * normal_number({seed, place});
    return static_cast<std::uint8_t>(std::lround(std::clamp(noisy, 0.0, 255.0)));
  }
};

Image<Rgb8> photograph(const Image<Rgb8>& scene, const PhoneCamera& camera, cv::Size size, const Exposure& exposure) {
  Image<Rgb8> picture(size.width, size.height);
  const cv::Mat from = as_mat(scene);
  cv::Mat to = as_mat(picture);
  tbb::parallel_for(tbb::blocked_range<int>(0, size.height, 16), [&](const tbb::blocked_range<int>& rows) {
    cv::Mat places(static_cast<int>(rows.size()), size.width, CV_32FC2);
    for (int y = rows.begin(); y < rows.end(); ++y)
      for (int x = 0; x < size.width; ++x)
        // OpenCV counts from the centre of the first pixel.
        places.at<cv::Point2f>(y - rows.begin(), x) = camera.in_scene({x + 0.5, y + 0.5}) - cv::Point2d(0.5, 0.5);
    cv::Mat band = to.rowRange(rows.begin(), rows.end());
    cv::remap(from, band, places, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    for (int y = rows.begin(); y < rows.end(); ++y)
      for (int x = 0; x < size.width; ++x) {
        Rgb8& pixel = picture(x, y);
        const std::uint64_t place = 3 * (static_cast<std::uint64_t>(y) * size.width + x);
        pixel = {exposure.of(pixel.r, place), exposure.of(pixel.g, place + 1), exposure.of(pixel.b, place + 2)};
      }
  });
  return picture;
}

Flow partners(const StereoGeometry& geometry, const PhoneCamera& left, const PhoneCamera& right, cv::Size size) {
  Flow flow{Image<float>(size.width, size.height), Image<float>(size.width, size.height)};
  const cv::Rect2d picture(0, 0, size.width, size.height);
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      flow.x(x, y) = flow.y(x, y) = std::numeric_limits<float>::quiet_NaN();
      const cv::Point2d here(x + 0.5, y + 0.5), there = left.in_scene(here);
      const int scene_x = static_cast<int>(std::floor(there.x)), scene_y = static_cast<int>(std::floor(there.y));
      if (!geometry.left_disparity.contains(scene_x, scene_y) || geometry.left_occlusion(scene_x, scene_y) != 0)
        continue;
      const double disparity = static_cast<double>(geometry.left_disparity(scene_x, scene_y));
      const cv::Point2d partner = right.photographed({there.x - disparity, there.y});
      if (!picture.contains(partner)) continue;
      flow.x(x, y) = static_cast<float>(partner.x - here.x);
      flow.y(x, y) = static_cast<float>(partner.y - here.y);
    }
  });
  return flow;
}

}  // namespace

PhonePair make_phone_pair(const SyntheticStillOptions& pictures, const PhoneCameraOptions& camera,
                          const Progress& progress) {
  SyntheticStillOptions wider = pictures;
  const cv::Size size(pictures.width, pictures.height);
  // Disparities by default belong to the pictures, not to what is cast around them.
  const float unit = static_cast<float>(pictures.width) / 640;
  wider.width += 2 * static_cast<int>(margin * size.width);
  wider.height += 2 * static_cast<int>(margin * size.height);
  if (!wider.largest_disparity_px) wider.largest_disparity_px = 45 * unit;
  if (!wider.least_disparity_px) wider.least_disparity_px = 6 * unit;
  const SyntheticStill scene = make_synthetic_still(wider, progress);
  report(progress, "taking photographs", 0);
  // The still life's cameras have shifted sensors; these have not, and look straight ahead.
  const double half_shift = static_cast<double>(still::make_cameras(wider).shift_px) / 2;
  const cv::Point2d middle(wider.width / 2.0, wider.height / 2.0), aside(half_shift, 0);
  enum Key : std::uint64_t { left_turn = 101, right_turn, left_noise, right_noise };
  const PhoneCamera left(middle - aside, size, camera, hash_keys({pictures.seed, left_turn}));
  const PhoneCamera right(middle + aside, size, camera, hash_keys({pictures.seed, right_turn}));
  PhonePair pair;
  pair.pictures.left =
      photograph(scene.pictures.left, left, size, {1, camera.noise, hash_keys({pictures.seed, left_noise})});
  pair.pictures.right = photograph(scene.pictures.right, right, size,
                                   {camera.right_exposure, camera.noise, hash_keys({pictures.seed, right_noise})});
  pair.left_to_right = partners(scene.geometry, left, right, size);
  return pair;
}

}  // namespace wheatstone
