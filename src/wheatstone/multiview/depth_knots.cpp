#include "wheatstone/multiview/depth_knots_internal.h"

#include <algorithm>
#include <cmath>

namespace wheatstone {
namespace {

constexpr double most_error_px = 1. / 32;  // corners are rounded on top of that

/// Splits a range of depths into parts in which a mapping that is linear in 1/depth is linear in depth, up to the
/// error.
void split_hyperbola(const DepthMapping& mapping, double near, double far, std::vector<double>& depths) {
  const auto parallax = [&](double depth) {
    return static_cast<double>(parallax_px(mapping, static_cast<float>(depth)));
  };
  const double middle = std::sqrt(near * far);  // where a chord of 1/depth is farthest from it
  const double share = (middle - near) / (far - near);
  const double chord = std::lerp(parallax(near), parallax(far), share);
  if (std::abs(chord - parallax(middle)) > most_error_px) {
    split_hyperbola(mapping, near, middle, depths);
    split_hyperbola(mapping, middle, far, depths);
  } else {
    depths.push_back(far);
  }
}

}  // namespace

DepthKnots::DepthKnots(const DepthMapping& mapping, const Camera& camera)
    : is_orthographic_(camera.orthographic_depth > 0) {
  const auto& points = mapping.points;
  std::vector<double> depths{points.front().depth};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (is_orthographic_)
      split_hyperbola(mapping, points[i - 1].depth, points[i].depth, depths);
    else
      depths.push_back(points[i].depth);
  }
  const auto disparity_at = [&](double depth) {
    return -static_cast<double>(parallax_px(mapping, static_cast<float>(depth)));
  };
  // Knots between which a line is near enough to all that are left out.
  for (std::size_t begin = 0; begin < depths.size();) {
    add(depths[begin], disparity_at(depths[begin]));
    std::size_t end = begin + 1;
    const auto fits = [&](std::size_t to) {
      for (std::size_t i = begin + 1; i < to; ++i) {
        const double share = (along(depths[i]) - along(depths[begin])) / (along(depths[to]) - along(depths[begin]));
        const double line = std::lerp(disparity_at(depths[begin]), disparity_at(depths[to]), share);
        if (std::abs(line - disparity_at(depths[i])) > most_error_px / 2) return false;
      }
      return true;
    };
    while (end + 1 < depths.size() && fits(end + 1)) ++end;
    begin = end;
  }
}

void DepthKnots::add(double depth, double disparity) {
  depths_.push_back(depth);
  along_.push_back(along(depth));
  disparities_.push_back(disparity);
}

std::size_t DepthKnots::segment_of(double depth) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(depths_, depth) - depths_.begin());
}

double DepthKnots::disparity(double depth) const {
  const std::size_t next = segment_of(depth);
  if (next == 0) return disparities_.front();
  if (next == depths_.size()) return disparities_.back();
  const double share = (along(depth) - along_[next - 1]) / (along_[next] - along_[next - 1]);
  return std::lerp(disparities_[next - 1], disparities_[next], share);
}

}  // namespace wheatstone
