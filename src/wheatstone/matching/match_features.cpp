#include "wheatstone/matching/match_features.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/nearest_descriptors_internal.h"

namespace wheatstone {
namespace {

struct Features {
  std::vector<PicturePoint> places;
  cv::Mat descriptors;
};

/// A picture as it is searched.
struct SearchedCopy {
  cv::Mat luminance;
  double x_scale = 1, y_scale = 1;  ///< its sides over the picture's
};

SearchedCopy searched_copy(ImageView<const Rgb8> picture, int side_px) {
  const double scale = std::min(1.0, static_cast<double>(side_px) / std::max(picture.width(), picture.height()));
  SearchedCopy copy;
  cv::cvtColor(as_mat(picture), copy.luminance, cv::COLOR_RGB2GRAY);
  if (scale < 1) copy.luminance = shrunk(copy.luminance, scale);
  copy.x_scale = static_cast<double>(copy.luminance.cols) / picture.width();
  copy.y_scale = static_cast<double>(copy.luminance.rows) / picture.height();
  return copy;
}

Features find_features(const SearchedCopy& copy, int most_features) {
  std::vector<cv::KeyPoint> keypoints;
  Features features;
  constexpr int octave_layers = 3;
  constexpr double contrast = 0.02, edge = 10, sigma = 1.6;  // half the usual contrast: dim and plain pictures too
  cv::SIFT::create(most_features, octave_layers, contrast, edge, sigma)
      ->detectAndCompute(copy.luminance, {}, keypoints, features.descriptors);
  // OpenCV counts from the centre of the first pixel.
  for (const cv::KeyPoint& point : keypoints)
    features.places.push_back({(static_cast<double>(point.pt.x) + 0.5) / copy.x_scale,
                               (static_cast<double>(point.pt.y) + 0.5) / copy.y_scale});
  return features;
}

struct FeaturesOfBoth {
  Features left, right;
};

FeaturesOfBoth find_features(ImageView<const Rgb8> left, ImageView<const Rgb8> right, const FeatureOptions& options) {
  SearchedCopy left_copy, right_copy;
  tbb::parallel_invoke([&] { left_copy = searched_copy(left, options.search_side_px); },
                       [&] { right_copy = searched_copy(right, options.search_side_px); });
  FeaturesOfBoth found;
  const auto find_left = [&] { found.left = find_features(left_copy, options.most_features); };
  const auto find_right = [&] { found.right = find_features(right_copy, options.most_features); };
  // SIFT takes about 230 bytes a pixel.
  constexpr std::size_t most_at_once_px = 2'000'000;
  if (left_copy.luminance.total() + right_copy.luminance.total() <= most_at_once_px) {
    tbb::parallel_invoke(find_left, find_right);
  } else {
    find_left();
    find_right();
  }
  return found;
}

/// Whether the nearest descriptor is clearly nearer than the next ones of other places. One place may have several
/// features, which differ in direction.
bool is_distinct(const NearestDescriptors& nearest, const Features& into, double best_to_second) {
  constexpr double same_place_px = 2;
  const PicturePoint& best = into.places[nearest.row[0]];
  for (int k = 1; k < NearestDescriptors::count && nearest.row[k] >= 0; ++k) {
    const PicturePoint& other = into.places[nearest.row[k]];
    if (std::hypot(best.x - other.x, best.y - other.y) < same_place_px) continue;
    const double share = best_to_second * best_to_second;
    if (static_cast<double>(nearest.squared_distance[0]) >= share * static_cast<double>(nearest.squared_distance[k]))
      return false;
  }
  return true;
}

/// Which features are clearly nearer to one feature of the other picture than to those of its other places.
struct NearestFeatures {
  std::vector<int> from, into;
};

NearestFeatures distinct_nearest(const Features& from, const Features& into, double best_to_second) {
  NearestFeatures result;
  const std::vector<NearestDescriptors> nearest = nearest_descriptors(from.descriptors, into.descriptors);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (!is_distinct(nearest[i], into, best_to_second)) continue;
    result.from.push_back(static_cast<int>(i));
    result.into.push_back(nearest[i].row[0]);
  }
  return result;
}

cv::Mat chosen_rows(const cv::Mat& rows, std::span<const int> indices) {
  cv::Mat result(0, rows.cols, rows.type());
  for (const int index : indices) result.push_back(rows.row(index));
  return result;
}

std::vector<cv::Point2d> side_of(std::span<const FeatureMatch> matches, PicturePoint FeatureMatch::*side) {
  std::vector<cv::Point2d> points;
  for (const FeatureMatch& match : matches) points.emplace_back((match.*side).x, (match.*side).y);
  return points;
}

}  // namespace

FeatureMatches match_features(ImageView<const Rgb8> left, ImageView<const Rgb8> right, const FeatureOptions& options) {
  const auto [in_left, in_right] = find_features(left, right, options);
  FeatureMatches result;
  result.left_features = static_cast<int>(in_left.places.size());
  result.right_features = static_cast<int>(in_right.places.size());
  if (in_left.places.size() < 2 || in_right.places.size() < 2) return result;
  const NearestFeatures there = distinct_nearest(in_left, in_right, options.best_to_second);
  // Only what was found is asked for the way back.
  const std::vector<NearestDescriptors> back =
      nearest_descriptors(chosen_rows(in_right.descriptors, there.into), in_left.descriptors);
  for (std::size_t i = 0; i < back.size(); ++i)
    if (back[i].row[0] == there.from[i] && is_distinct(back[i], in_left, options.best_to_second))
      result.matches.push_back({in_left.places[there.from[i]], in_right.places[there.into[i]]});

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
  const double steepness = std::sqrt(line_in_right[0] * line_in_right[0] + line_in_right[1] * line_in_right[1] +
                                     line_in_left[0] * line_in_left[0] + line_in_left[1] * line_in_left[1]);
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
