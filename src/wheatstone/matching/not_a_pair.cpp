#include "wheatstone/matching/not_a_pair.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/image/shrunk_opencv.h"
#include "wheatstone/matching/block_agreement.h"

namespace wheatstone {
namespace {

cv::Mat luminance(const Image<Rgb8>& picture) {
  constexpr int widest_px = 640;
  const double scale = std::min(1.0, static_cast<double>(widest_px) / picture.width());
  cv::Mat small = shrunk(as_mat(picture), scale);
  cv::cvtColor(small, small, cv::COLOR_RGB2GRAY);
  return small;
}

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

Features features_of(const Image<Rgb8>& picture) {
  constexpr int most = 1000;
  Features found;
  cv::SIFT::create(most)->detectAndCompute(luminance(picture), {}, found.points, found.descriptors);
  return found;
}

/// Points of both that are each other's best and clearly better than the second best (Lowe's ratio).
void matched_points(const Features& left, const Features& right, std::vector<cv::Point2f>& in_left,
                    std::vector<cv::Point2f>& in_right) {
  constexpr float clearly_better = 0.75f;
  std::vector<std::vector<cv::DMatch>> forth;
  std::vector<cv::DMatch> back;
  const cv::BFMatcher matcher(cv::NORM_L2);
  matcher.knnMatch(left.descriptors, right.descriptors, forth, 2);
  matcher.match(right.descriptors, left.descriptors, back);
  for (const std::vector<cv::DMatch>& best : forth) {
    if (best.size() < 2 || best[0].distance > clearly_better * best[1].distance) continue;
    if (back[best[0].trainIdx].trainIdx != best[0].queryIdx) continue;
    in_left.push_back(left.points[best[0].queryIdx].pt);
    in_right.push_back(right.points[best[0].trainIdx].pt);
  }
}

}  // namespace

PairEvidence pair_evidence(const StereoPair& pair) {
  PairEvidence evidence;
  const Features left = features_of(pair.left), right = features_of(pair.right);
  evidence.left_features = static_cast<int>(left.points.size());
  evidence.right_features = static_cast<int>(right.points.size());
  evidence.block_share = block_agreement(pair.left, pair.right).share;
  constexpr std::size_t least_points = 2;
  if (left.points.size() < least_points || right.points.size() < least_points) return evidence;

  std::vector<cv::Point2f> in_left, in_right;
  matched_points(left, right, in_left, in_right);
  evidence.matches = static_cast<int>(in_left.size());
  constexpr int least_for_geometry = 8;
  if (evidence.matches < least_for_geometry) return evidence;
  constexpr double epipolar_px = 1.5, confidence = 0.99;
  std::vector<std::uint8_t> inlier;
  cv::findFundamentalMat(in_left, in_right, cv::FM_RANSAC, epipolar_px, confidence, inlier);
  evidence.inliers = static_cast<int>(std::count(inlier.begin(), inlier.end(), std::uint8_t{1}));
  return evidence;
}

bool not_a_pair(const StereoPair& pair) {
  // Pairs have hundreds of inliers, two scenes fewer than ten (not_a_pair_test).
  constexpr int least_features = 100, least_inliers = 20;
  constexpr double least_share = 0.02, least_block_share = 0.1;
  const PairEvidence evidence = pair_evidence(pair);
  const int features = std::min(evidence.left_features, evidence.right_features);
  if (features < least_features) return false;
  const bool features_fit = evidence.inliers >= least_inliers && evidence.inliers >= least_share * features;
  return !features_fit && evidence.block_share < least_block_share;
}

}  // namespace wheatstone
