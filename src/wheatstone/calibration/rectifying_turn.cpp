#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "wheatstone/calibration/rectifying_turn_internal.h"

namespace wheatstone {
namespace {

/// What is unknown of the two cameras. The left one's pitch is free: both can turn around the line that joins them.
enum Unknown { left_yaw, left_roll, right_pitch, right_yaw, right_roll, log_focal, log_scale, offset, unknowns };

/// How far each is likely to be from that of an upright rig: radians, natural logarithms, and shares of the height. The
/// focal length is looked for around that of a lens whose picture is 45 degrees wide.
constexpr std::array<double, unknowns> likely{0.15, 0.1, 0.1, 0.15, 0.1, 0.5, 0.05, 0.03};
constexpr double usual_focal_to_side = 1.2;
constexpr double noise_px = 0.5;

using Parameters = std::array<double, unknowns>;

cv::Matx33d rotation(double pitch, double yaw, double roll) {
  const auto about = [](const cv::Vec3d& axis) {
    cv::Matx33d matrix;
    cv::Rodrigues(axis, matrix);
    return matrix;
  };
  return about({pitch, 0, 0}) * about({0, yaw, 0}) * about({0, 0, roll});
}

/// Both pictures' homographies to the turned cameras, and the epipolar geometry that they stand for.
RectifyingTurn turn_of(const Parameters& p, cv::Size size) {
  const double focal = std::exp(p[log_focal]) * usual_focal_to_side * std::max(size.width, size.height);
  const double x = size.width / 2.0, y = size.height / 2.0;
  const double right_focal = focal * std::exp(p[log_scale]);
  const cv::Matx33d turned(focal, 0, x, 0, focal, y, 0, 0, 1);
  const cv::Matx33d right_camera(right_focal, 0, x, 0, right_focal, y + p[offset] * size.height, 0, 0, 1);
  const cv::Matx33d left_rays = rotation(0, p[left_yaw], p[left_roll]) * turned.inv();
  const cv::Matx33d right_rays = rotation(p[right_pitch], p[right_yaw], p[right_roll]) * right_camera.inv();
  const cv::Matx33d same_row(0, 0, 0, 0, 0, 1, 0, -1, 0);
  const cv::Matx33d fundamental = right_rays.t() * same_row * left_rays;
  RectifyingTurn turn{turned * left_rays, turned * right_rays};
  std::copy_n(fundamental.val, 9, turn.fundamental.begin());
  return turn;
}

/// Grows like the logarithm, so that wrong matches pull no harder than right ones.
double tamed(double residual) { return std::copysign(std::sqrt(std::log1p(residual * residual)), residual); }

class Residuals : public cv::LMSolver::Callback {
 public:
  Residuals(std::span<const FeatureMatch> matches, cv::Size size, double believed_px)
      : matches_(matches), size_(size), believed_px_(believed_px) {}

  bool compute(cv::InputArray parameters, cv::OutputArray error, cv::OutputArray jacobian) const override {
    Parameters p{};
    std::copy_n(parameters.getMat().ptr<double>(), unknowns, p.begin());
    const std::vector<double> here = residuals(p);
    cv::Mat(here, true).copyTo(error);
    if (!jacobian.needed()) return true;
    jacobian.create(static_cast<int>(here.size()), unknowns, CV_64F);
    cv::Mat slopes = jacobian.getMat();
    for (int k = 0; k < unknowns; ++k) {
      constexpr double step = 1e-6;
      Parameters more = p, less = p;
      more[k] += step;
      less[k] -= step;
      const std::vector<double> after = residuals(more), before = residuals(less);
      for (std::size_t i = 0; i < here.size(); ++i)
        slopes.at<double>(static_cast<int>(i), k) = (after[i] - before[i]) / (2 * step);
    }
    return true;
  }

 private:
  std::vector<double> residuals(const Parameters& p) const {
    const RectifyingTurn turn = turn_of(p, size_);
    std::vector<double> all;
    all.reserve(matches_.size() + unknowns);
    for (const FeatureMatch& match : matches_)
      all.push_back(tamed(sampson_distance(turn.fundamental, match) / believed_px_));
    for (int k = 0; k < unknowns; ++k) all.push_back(p[k] / likely[k]);
    return all;
  }

  std::span<const FeatureMatch> matches_;
  cv::Size size_;
  double believed_px_;
};

}  // namespace

cv::Point2d carried(const cv::Matx33d& homography, const PicturePoint& point) {
  const cv::Vec3d place = homography * cv::Vec3d(point.x, point.y, 1);
  return {place[0] / place[2], place[1] / place[2]};
}

RectifyingTurn find_rectifying_turn(std::span<const FeatureMatch> matches, cv::Size size) {
  cv::Mat parameters = cv::Mat::zeros(unknowns, 1, CV_64F);
  constexpr int most_steps = 100;
  // At first every match is believed: far from the solution the right ones look wrong too.
  for (const double believed_px : {64 * noise_px, 8 * noise_px, noise_px})
    cv::LMSolver::create(cv::makePtr<Residuals>(matches, size, believed_px), most_steps)->run(parameters);
  Parameters p{};
  std::copy_n(parameters.ptr<double>(), unknowns, p.begin());
  RectifyingTurn turn = turn_of(p, size);

  // Turned towards each other or away, the pictures would wander off sideways.
  const PicturePoint middle{size.width / 2.0, size.height / 2.0};
  const cv::Point2d left = carried(turn.left, middle), right = carried(turn.right, middle);
  const double up = middle.y - (left.y + right.y) / 2;
  turn.left = cv::Matx33d(1, 0, middle.x - left.x, 0, 1, up, 0, 0, 1) * turn.left;
  turn.right = cv::Matx33d(1, 0, middle.x - right.x, 0, 1, up, 0, 0, 1) * turn.right;
  return turn;
}

void settle_rows(RectifyingTurn& turn, std::span<const FeatureMatch> matches, cv::Size size) {
  constexpr int rounds = 10;
  cv::Vec3d correction(0, 0, 0);
  for (int round = 0; round < rounds; ++round) {
    cv::Matx33d normal = cv::Matx33d::eye() * 1e-9;
    cv::Vec3d target(0, 0, 0);
    for (const FeatureMatch& match : matches) {
      const cv::Point2d left = carried(turn.left, match.left), right = carried(turn.right, match.right);
      const cv::Vec3d row(1, right.x / size.width - 0.5, right.y / size.height - 0.5);
      const double miss = left.y - right.y;
      const double off = (miss - row.dot(correction)) / noise_px;
      const double weight = 1 / (1 + off * off);
      normal += weight * (row * row.t());
      target += weight * miss * row;
    }
    correction = normal.solve(target, cv::DECOMP_SVD);
  }
  turn.right = cv::Matx33d(1, 0, 0, correction[1] / size.width, 1 + correction[2] / size.height,
                           correction[0] - (correction[1] + correction[2]) / 2, 0, 0, 1) *
               turn.right;
}

}  // namespace wheatstone
