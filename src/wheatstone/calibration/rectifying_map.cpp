#include "wheatstone/calibration/rectifying_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheatstone/calibration/rectifying_map_internal.h"

namespace wheatstone {
namespace {

PicturePoint middle_of(const RectifyingMap& map) { return {map.width / 2.0, map.height / 2.0}; }

double half_diagonal_squared(const RectifyingMap& map) {
  const double width = map.width, height = map.height;
  return (width * width + height * height) / 4;
}

PicturePoint distorted_place(const RectifyingMap& map, PicturePoint straightened) {
  const PicturePoint middle = middle_of(map);
  const double x = straightened.x - middle.x, y = straightened.y - middle.y;
  const double target_squared = (x * x + y * y) / half_diagonal_squared(map);  // of r / (1 − s r²), solved for r
  const double root = std::sqrt(std::max(1 + 4 * map.straightening * target_squared, 0.0));
  const double ratio = 2 / (1 + root);
  return {middle.x + ratio * x, middle.y + ratio * y};
}

double row_correction_at(const RectifyingMap& map, PicturePoint straightened) {
  const std::array<double, 10> terms = row_terms(map, straightened);
  return std::inner_product(terms.begin(), terms.end(), map.row_correction.begin(), 0.0);
}

}  // namespace

std::array<double, 10> row_terms(const RectifyingMap& map, PicturePoint straightened) {
  const double side = std::max(map.width, map.height);
  const double x = (straightened.x - map.width / 2.0) / side, y = (straightened.y - map.height / 2.0) / side;
  return {1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y};
}

PicturePoint straightened_place(const RectifyingMap& map, PicturePoint in_photograph) {
  if (map.straightening == 0) return in_photograph;
  const PicturePoint middle = middle_of(map);
  const double x = in_photograph.x - middle.x, y = in_photograph.y - middle.y;
  constexpr double most_grown = 10;  // beyond, the model folds the picture over
  const double grown =
      1 / std::max(1 - map.straightening * (x * x + y * y) / half_diagonal_squared(map), 1 / most_grown);
  return {middle.x + grown * x, middle.y + grown * y};
}

PicturePoint carried(const cv::Matx33d& homography, PicturePoint point) {
  const cv::Vec3d place = homography * cv::Vec3d(point.x, point.y, 1);
  return {place[0] / place[2], place[1] / place[2]};
}

PicturePoint rectified_place(const RectifyingMap& map, PicturePoint in_photograph) {
  const PicturePoint straight = straightened_place(map, in_photograph);
  PicturePoint place = carried(cv::Matx33d(map.homography.data()), straight);
  place.y += row_correction_at(map, straight);
  return place;
}

PicturePoint photograph_place(const RectifyingMap& map, const cv::Matx33d& homography_back, PicturePoint in_rectified) {
  PicturePoint straight = carried(homography_back, in_rectified);
  // The field changes by a few hundredths of a pixel a pixel: each round wins more than one digit.
  constexpr int rounds = 4;
  if (map.row_correction != std::array<double, 10>{})
    for (int round = 0; round < rounds; ++round)
      straight = carried(homography_back, {in_rectified.x, in_rectified.y - row_correction_at(map, straight)});
  return map.straightening == 0 ? straight : distorted_place(map, straight);
}

PicturePoint photograph_place(const RectifyingMap& map, PicturePoint in_rectified) {
  return photograph_place(map, cv::Matx33d(map.homography.data()).inv(), in_rectified);
}

void follow_with(RectifyingMap& map, const cv::Matx33d& after) {
  const cv::Matx33d both = after * cv::Matx33d(map.homography.data());
  std::copy_n(both.val, 9, map.homography.begin());
  for (double& coefficient : map.row_correction) coefficient *= after(1, 1);
}

}  // namespace wheatstone
