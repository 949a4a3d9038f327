#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>
#include <vector>

#include "wheatstone/calibration/rectifying_map_internal.h"
#include "wheatstone/calibration/rectifying_turn_internal.h"

namespace wheatstone {
namespace {

/// What is unknown of the two cameras. The left one's pitch is free: both can turn around the line that joins them.
/// Distortion is the last, so that a straight lens's parameters are the first ones.
enum Unknown {
  left_yaw,
  left_roll,
  right_pitch,
  right_yaw,
  right_roll,
  log_focal,
  log_scale,
  offset,
  distortion,
  unknowns
};

/// How far each is likely to be from that of an upright rig: radians, natural logarithms, shares of the height, and the
/// straightening of RectifyingMap. The focal length is looked for around that of a lens whose picture is 53 degrees
/// wide.
constexpr std::array<double, unknowns> likely{0.04, 0.02, 0.04, 0.04, 0.02, 0.5, 0.05, 0.03, 0.1};
constexpr double usual_focal_to_side = 1;
constexpr double noise_px = 0.5;
/// Neighbouring matches are wrong alike: more than this many say no more.
constexpr double independent_matches = 300;

using Parameters = std::array<double, unknowns>;

cv::Matx33d rotation(double pitch, double yaw, double roll) {
  const auto about = [](const cv::Vec3d& axis) {
    cv::Matx33d matrix;
    cv::Rodrigues(axis, matrix);
    return matrix;
  };
  return about({pitch, 0, 0}) * about({0, yaw, 0}) * about({0, 0, roll});
}

RectifyingMap map_of(const cv::Matx33d& homography, double straightening, cv::Size size) {
  RectifyingMap map{.width = size.width, .height = size.height, .straightening = straightening};
  std::copy_n(homography.val, 9, map.homography.begin());
  return map;
}

/// Both pictures' maps to the turned cameras, and the epipolar geometry that they stand for.
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
  RectifyingTurn turn{map_of(turned * left_rays, p[distortion], size),
                      map_of(turned * right_rays, p[distortion], size)};
  std::copy_n(fundamental.val, 9, turn.fundamental.begin());
  return turn;
}

double signed_miss(const RectifyingTurn& turn, const FeatureMatch& match) {
  return sampson_distance(turn.fundamental,
                          {straightened_place(turn.left, match.left), straightened_place(turn.right, match.right)});
}

/// What a match counts that misses by so much (Cauchy's weight): wrong matches pull hardly at all.
double weight_of(double miss_px, double believed_px) { return 1 / (1 + std::pow(miss_px / believed_px, 2)); }

/// Matches, and how far they are believed; minimises Σ log(1 + (miss / believed)²) + Σ (parameter / likely)² over the
/// first `count` parameters by Levenberg and Marquardt's method with weights.
class TurnFit {
 public:
  TurnFit(std::span<const FeatureMatch> matches, cv::Size size, int count)
      : matches_(matches),
        size_(size),
        count_(count),
        prior_weight_(std::max(1.0, static_cast<double>(matches.size()) / independent_matches)) {}

  void minimise(Parameters& p, double believed_px) const {
    constexpr int most_steps = 60;
    constexpr double least_gain = 1e-7, most_damping = 1e8;
    std::vector<double> misses = misses_of(p);
    double cost = cost_of(p, misses, believed_px), damping = 1e-3;
    for (int step = 0; step < most_steps && damping < most_damping; ++step) {
      const auto [normal, gradient] = equations(p, misses, believed_px);
      for (bool better = false; !better && damping < most_damping;) {
        const Parameters next = stepped(p, normal, gradient, damping);
        std::vector<double> next_misses = misses_of(next);
        const double next_cost = cost_of(next, next_misses, believed_px);
        better = next_cost < cost;
        damping *= better ? 0.1 : 10;
        if (!better) continue;
        const bool done = cost - next_cost < least_gain * cost;
        p = next;
        misses = std::move(next_misses);
        cost = next_cost;
        if (done) return;
      }
    }
  }

 private:
  std::vector<double> misses_of(const Parameters& p) const {
    const RectifyingTurn turn = turn_of(p, size_);
    std::vector<double> misses;
    misses.reserve(matches_.size());
    for (const FeatureMatch& match : matches_) misses.push_back(signed_miss(turn, match));
    return misses;
  }

  double cost_of(const Parameters& p, const std::vector<double>& misses, double believed_px) const {
    double cost = 0;
    for (const double miss : misses) cost += std::log1p(std::pow(miss / believed_px, 2));
    for (int k = 0; k < count_; ++k) cost += prior_weight_ * std::pow(p[k] / likely[k], 2);
    return cost;
  }

  struct Equations {
    cv::Mat normal, gradient;
  };

  Equations equations(const Parameters& p, const std::vector<double>& misses, double believed_px) const {
    cv::Mat slopes(count_, static_cast<int>(misses.size()), CV_64F), weighted = slopes.clone();
    oneapi::tbb::parallel_for(0, count_, [&](int k) {
      constexpr double step = 1e-6;
      Parameters more = p, less = p;
      more[k] += step;
      less[k] -= step;
      const std::vector<double> after = misses_of(more), before = misses_of(less);
      for (int i = 0; i < slopes.cols; ++i) {
        slopes.at<double>(k, i) = (after[i] - before[i]) / (2 * step);
        weighted.at<double>(k, i) =
            slopes.at<double>(k, i) * weight_of(misses[i], believed_px) / (believed_px * believed_px);
      }
    });
    Equations found{weighted * slopes.t(), weighted * cv::Mat(misses)};
    for (int k = 0; k < count_; ++k) {
      found.normal.at<double>(k, k) += prior_weight_ / (likely[k] * likely[k]);
      found.gradient.at<double>(k) += prior_weight_ * p[k] / (likely[k] * likely[k]);
    }
    return found;
  }

  Parameters stepped(Parameters p, const cv::Mat& normal, const cv::Mat& gradient, double damping) const {
    cv::Mat damped = normal.clone(), step;
    damped.diag() += damping * normal.diag();
    cv::solve(damped, gradient, step, cv::DECOMP_SVD);
    for (int k = 0; k < count_; ++k) p[k] -= step.at<double>(k);
    return p;
  }

  std::span<const FeatureMatch> matches_;
  cv::Size size_;
  int count_;
  double prior_weight_;
};

/// Weighted least squares, again and again, so that rows that fit badly count little: what must be added to the right
/// picture's rows, in coefficients of `terms` of each match.
template <int count>
cv::Vec<double, count> robust_row_fit(const std::vector<cv::Vec<double, count>>& terms,
                                      const std::vector<double>& misses, double damping) {
  constexpr int rounds = 10;
  cv::Vec<double, count> fit = cv::Vec<double, count>::all(0);
  for (int round = 0; round < rounds; ++round) {
    cv::Matx<double, count, count> normal = cv::Matx<double, count, count>::eye() * damping;
    cv::Vec<double, count> target = cv::Vec<double, count>::all(0);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const double weight = weight_of(misses[i] - terms[i].dot(fit), noise_px);
      normal += weight * (terms[i] * terms[i].t());
      target += weight * misses[i] * terms[i];
    }
    fit = normal.solve(target, cv::DECOMP_SVD);
  }
  return fit;
}

}  // namespace

RectifyingTurn find_rectifying_turn(std::span<const FeatureMatch> matches, cv::Size size, LensModel lens) {
  const TurnFit fit(matches, size, lens == LensModel::radial ? unknowns : distortion);
  Parameters p{};
  // At first every match is believed: far from the solution the right ones look wrong too.
  for (const double believed_px : {64 * noise_px, 8 * noise_px, noise_px}) fit.minimise(p, believed_px);
  RectifyingTurn turn = turn_of(p, size);

  // Turned towards each other or away, the pictures would wander off sideways.
  const PicturePoint middle{size.width / 2.0, size.height / 2.0};
  const PicturePoint left = rectified_place(turn.left, middle), right = rectified_place(turn.right, middle);
  const double up = middle.y - (left.y + right.y) / 2;
  follow_with(turn.left, cv::Matx33d(1, 0, middle.x - left.x, 0, 1, up, 0, 0, 1));
  follow_with(turn.right, cv::Matx33d(1, 0, middle.x - right.x, 0, 1, up, 0, 0, 1));
  return turn;
}

double miss_of(const RectifyingTurn& turn, const FeatureMatch& match) { return std::abs(signed_miss(turn, match)); }

void settle_rows(RectifyingTurn& turn, std::span<const FeatureMatch> matches) {
  const double width = turn.right.width, height = turn.right.height;
  std::vector<cv::Vec3d> terms;
  std::vector<double> misses;
  for (const FeatureMatch& match : rectified_matches(turn, matches)) {
    terms.emplace_back(1, match.right.x / width - 0.5, match.right.y / height - 0.5);
    misses.push_back(match.left.y - match.right.y);
  }
  const cv::Vec3d fit = robust_row_fit(terms, misses, 1e-9);
  follow_with(turn.right,
              cv::Matx33d(1, 0, 0, fit[1] / width, 1 + fit[2] / height, fit[0] - (fit[1] + fit[2]) / 2, 0, 0, 1));
}

void settle_rows_smoothly(RectifyingTurn& turn, std::span<const FeatureMatch> matches) {
  std::vector<cv::Vec<double, 10>> terms;
  std::vector<double> misses;
  const std::vector<FeatureMatch> there = rectified_matches(turn, matches);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    terms.emplace_back(row_terms(turn.right, straightened_place(turn.right, matches[i].right)).data());
    misses.push_back(there[i].left.y - there[i].right.y);
  }
  // Where there are no matches the field shall not grow.
  const double damping = 1e-4 * static_cast<double>(matches.size());
  const cv::Vec<double, 10> fit = robust_row_fit(terms, misses, damping);
  for (int k = 0; k < 10; ++k) turn.right.row_correction[k] += fit[k];
}

std::vector<FeatureMatch> rectified_matches(const RectifyingTurn& turn, std::span<const FeatureMatch> matches) {
  std::vector<FeatureMatch> result;
  result.reserve(matches.size());
  for (const FeatureMatch& match : matches)
    result.push_back({rectified_place(turn.left, match.left), rectified_place(turn.right, match.right)});
  return result;
}

}  // namespace wheatstone
