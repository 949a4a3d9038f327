#include "wheatstone/matching/match_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

struct Features {
  std::vector<PicturePoint> places;
  cv::Mat descriptors;
};

Features find_features(ImageView<const Rgb8> picture, const FeatureOptions& options) {
  const double scale =
      std::min(1.0, static_cast<double>(options.search_side_px) / std::max(picture.width(), picture.height()));
  cv::Mat luminance;
  cv::cvtColor(as_mat(picture), luminance, cv::COLOR_RGB2GRAY);
  if (scale < 1) cv::resize(luminance, luminance, {}, scale, scale, cv::INTER_AREA);
  const double x_scale = static_cast<double>(luminance.cols) / picture.width();
  const double y_scale = static_cast<double>(luminance.rows) / picture.height();
  std::vector<cv::KeyPoint> keypoints;
  Features features;
  constexpr int octave_layers = 3;
  constexpr double contrast = 0.02, edge = 10, sigma = 1.6;  // half the usual contrast: dim and plain pictures too
  cv::SIFT::create(options.most_features, octave_layers, contrast, edge, sigma)
      ->detectAndCompute(luminance, {}, keypoints, features.descriptors);
  // OpenCV counts from the centre of the first pixel.
  for (const cv::KeyPoint& point : keypoints)
    features.places.push_back(
        {(static_cast<double>(point.pt.x) + 0.5) / x_scale, (static_cast<double>(point.pt.y) + 0.5) / y_scale});
  return features;
}

/// For each feature its closest one in the other picture, or −1 where the second closest, at another place, is about
/// as close. One place may have several features, which differ in direction.
std::vector<int> closest(const Features& from, const Features& into, double best_to_second) {
  std::vector<int> result(from.places.size(), -1);
  std::vector<std::vector<cv::DMatch>> found;
  constexpr int candidates = 3;
  cv::BFMatcher(cv::NORM_L2).knnMatch(from.descriptors, into.descriptors, found, candidates);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) continue;
    const PicturePoint& best = into.places[found[i][0].trainIdx];
    bool distinct = true;
    for (std::size_t k = 1; k < found[i].size() && distinct; ++k) {
      const PicturePoint& other = into.places[found[i][k].trainIdx];
      const bool same_place = std::hypot(best.x - other.x, best.y - other.y) < 2;
      distinct = same_place ||
                 static_cast<double>(found[i][0].distance) < best_to_second * static_cast<double>(found[i][k].distance);
    }
    if (distinct) result[i] = found[i][0].trainIdx;
  }
  return result;
}

std::vector<cv::Point2d> side_of(std::span<const FeatureMatch> matches, PicturePoint FeatureMatch::*side) {
  std::vector<cv::Point2d> points;
  for (const FeatureMatch& match : matches) points.emplace_back((match.*side).x, (match.*side).y);
  return points;
}

}  // namespace

FeatureMatches match_features(ImageView<const Rgb8> left, ImageView<const Rgb8> right, const FeatureOptions& options) {
  const Features in_left = find_features(left, options), in_right = find_features(right, options);
  FeatureMatches result;
  result.left_features = static_cast<int>(in_left.places.size());
  result.right_features = static_cast<int>(in_right.places.size());
  if (in_left.places.size() < 2 || in_right.places.size() < 2) return result;
  const std::vector<int> there = closest(in_left, in_right, options.best_to_second);
  const std::vector<int> back = closest(in_right, in_left, options.best_to_second);
  for (std::size_t i = 0; i < there.size(); ++i)
    if (there[i] >= 0 && back[there[i]] == static_cast<int>(i))
      result.matches.push_back({in_left.places[i], in_right.places[there[i]]});

  // Features of one place that differ in direction only are one match.
  const auto same = [](const FeatureMatch& a, const FeatureMatch& b) {
    return std::abs(a.left.x - b.left.x) < 0.01 && std::abs(a.left.y - b.left.y) < 0.01;
  };
  std::ranges::sort(result.matches, {}, [](const FeatureMatch& m) {
    return std::array{m.left.x, m.left.y, m.right.x, m.right.y};
  });
  result.matches.erase(std::unique(result.matches.begin(), result.matches.end(), same), result.matches.end());
  return result;
}

double sampson_distance(const std::array<double, 9>& fundamental, const FeatureMatch& match) {
  const cv::Matx33d f(fundamental.data());
  const cv::Vec3d left(match.left.x, match.left.y, 1), right(match.right.x, match.right.y, 1);
  const cv::Vec3d line_in_right = f * left, line_in_left = f.t() * right;
  const double steepness =
      std::hypot(std::hypot(line_in_right[0], line_in_right[1]), std::hypot(line_in_left[0], line_in_left[1]));
  return steepness > 0 ? right.dot(line_in_right) / steepness : 0;
}

EpipolarGeometry find_epipolar_geometry(std::span<const FeatureMatch> matches, double tolerance_px) {
  EpipolarGeometry geometry;
  constexpr std::size_t least_matches = 8;
  if (matches.size() < least_matches) return geometry;
  const std::vector<cv::Point2d> left = side_of(matches, &FeatureMatch::left);
  const std::vector<cv::Point2d> right = side_of(matches, &FeatureMatch::right);
  constexpr double confidence = 0.9999;
  constexpr int most_trials = 10000;
  const cv::Mat found = cv::findFundamentalMat(left, right, cv::USAC_MAGSAC, tolerance_px, confidence, most_trials);
  if (found.rows != 3 || found.cols != 3) return geometry;
  std::copy_n(found.ptr<double>(), 9, geometry.fundamental.begin());
  for (const FeatureMatch& match : matches)
    if (std::abs(sampson_distance(geometry.fundamental, match)) <= tolerance_px) geometry.inliers.push_back(match);
  if (geometry.inliers.size() < least_matches) return geometry;

  geometry.off_plane = static_cast<int>(geometry.inliers.size());
  const std::vector<cv::Point2d> from = side_of(geometry.inliers, &FeatureMatch::left);
  const std::vector<cv::Point2d> to = side_of(geometry.inliers, &FeatureMatch::right);
  const cv::Mat homography =
      cv::findHomography(from, to, cv::USAC_MAGSAC, tolerance_px, cv::noArray(), most_trials, confidence);
  if (homography.empty()) return geometry;
  std::vector<cv::Point2d> carried;
  cv::perspectiveTransform(from, carried, homography);
  for (std::size_t i = 0; i < to.size(); ++i)
    if (cv::norm(carried[i] - to[i]) <= 1.5 * tolerance_px) --geometry.off_plane;
  return geometry;
}

}  // namespace wheatstone
