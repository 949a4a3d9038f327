#include "wheatstone/matching/not_a_pair.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {

namespace {

constexpr int small_width_px = 192, block_px = 13, step_px = 7;
constexpr int largest_sideways_px = small_width_px / 3, largest_vertical_px = 4;
constexpr double least_contrast = 4;  // standard deviation, of 255
constexpr double least_correlation = 0.7;

cv::Mat small_luminance(ImageView<const Rgb8> picture) {
  const double scale = std::min(1.0, static_cast<double>(small_width_px) / picture.width());
  cv::Mat small = shrunk(as_mat(picture), scale);
  cv::cvtColor(small, small, cv::COLOR_RGB2GRAY);
  return small;
}

/// Where a block of `from` at this corner is found in `to`; none where nothing is like it, or more than one place is:
/// a pattern tells nothing.
std::optional<cv::Point> found_in(const cv::Mat& from, const cv::Mat& to, cv::Point corner) {
  const cv::Rect reach(corner.x - largest_sideways_px, corner.y - largest_vertical_px,
                       block_px + 2 * largest_sideways_px, block_px + 2 * largest_vertical_px);
  const cv::Rect inside = reach & cv::Rect(0, 0, to.cols, to.rows);
  if (inside.width < block_px || inside.height < block_px) return {};
  cv::Mat correlation;
  cv::matchTemplate(to(inside), from({corner, cv::Size(block_px, block_px)}), correlation, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point place;
  cv::minMaxLoc(correlation, nullptr, &best, nullptr, &place);
  if (!(best >= least_correlation)) return {};
  const cv::Rect around(place.x - block_px / 2, 0, block_px, correlation.rows);
  correlation(around & cv::Rect(0, 0, correlation.cols, correlation.rows)) = -1;
  double second = 0;
  cv::minMaxLoc(correlation, nullptr, &second);
  constexpr double clearly_better = 0.02;
  if (second > best - clearly_better) return {};
  return place + inside.tl();
}

/// A block's move where it was found and found back.
struct Block {
  bool textured = false;
  std::optional<cv::Point> move;
};

Block look_for(const cv::Mat& a, const cv::Mat& b, cv::Point corner) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(a({corner, cv::Size(block_px, block_px)}), mean, deviation);
  if (deviation[0] < least_contrast) return {};
  const std::optional<cv::Point> there = found_in(a, b, corner);
  if (!there) return {true, {}};
  const std::optional<cv::Point> back = found_in(b, a, *there);
  constexpr int tolerance_px = 1;
  if (!back || std::abs(back->x - corner.x) > tolerance_px || std::abs(back->y - corner.y) > tolerance_px)
    return {true, {}};
  return {true, *there - corner};
}

bool move_alike(const Block& a, const Block& b) {
  constexpr int sideways_px = 3, vertical_px = 1;
  return a.move && b.move && std::abs(a.move->x - b.move->x) <= sideways_px &&
         std::abs(a.move->y - b.move->y) <= vertical_px;
}

}  // namespace

BlockAgreement block_agreement(ImageView<const Rgb8> a, ImageView<const Rgb8> b, double least_share) {
  const cv::Mat from = small_luminance(a), to = small_luminance(b);
  if (from.cols < block_px || from.rows < block_px) return {};
  const int columns = (from.cols - block_px) / step_px + 1, rows = (from.rows - block_px) / step_px + 1;
  Image<Block> blocks(columns, rows);
  const auto look_at_row = [&](int y) {
    for (int x = 0; x < columns; ++x) blocks(x, y) = look_for(from, to, {x * step_px, y * step_px});
  };
  BlockAgreement agreement;
  int found = 0;
  constexpr int rows_a_look = 3;
  for (int y = 0; y < rows; y += rows_a_look) {
    look_at_row(y);
    for (const Block& block : blocks.row(y)) {
      agreement.blocks += block.textured ? 1 : 0;
      found += block.move ? 1 : 0;
    }
  }
  constexpr int enough_blocks = 12;
  if (agreement.blocks >= enough_blocks && found < least_share * agreement.blocks) return agreement;
  for (int y = 0; y < rows; ++y)
    if (y % rows_a_look != 0) look_at_row(y);

  agreement.blocks = 0;
  int agreeing = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      if (!blocks(x, y).textured) continue;
      ++agreement.blocks;
      // What was found by chance moves as no neighbour does.
      int alike = 0;
      for (const cv::Point offset : {cv::Point(-2, 0), {2, 0}, {0, -2}, {0, 2}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}})
        if (blocks.contains(x + offset.x, y + offset.y) && move_alike(blocks(x, y), blocks(x + offset.x, y + offset.y)))
          ++alike;
      constexpr int least_alike = 2;
      if (alike >= least_alike) ++agreeing;
    }
  }
  if (agreement.blocks > 0) agreement.share = static_cast<double>(agreeing) / agreement.blocks;
  return agreement;
}

namespace {

cv::Mat luminance(const Image<Rgb8>& picture) {
  constexpr int widest_px = 640;
  const double scale = std::min(1.0, static_cast<double>(widest_px) / picture.width());
  cv::Mat small = shrunk(as_mat(picture), scale);
  cv::cvtColor(small, small, cv::COLOR_RGB2GRAY);
  return small;
}

struct DescribedPoints {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

DescribedPoints features_of(const Image<Rgb8>& picture) {
  constexpr int most = 1000;
  DescribedPoints found;
  cv::SIFT::create(most)->detectAndCompute(luminance(picture), {}, found.points, found.descriptors);
  return found;
}

/// Points of both that are each other's best and clearly better than the second best (Lowe's ratio).
void matched_points(const DescribedPoints& left, const DescribedPoints& right, std::vector<cv::Point2f>& in_left,
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

constexpr double least_block_share = 0.1;  // of a pair

}  // namespace

PairEvidence pair_evidence(const StereoPair& pair) {
  PairEvidence evidence;
  const DescribedPoints left = features_of(pair.left), right = features_of(pair.right);
  evidence.left_features = static_cast<int>(left.points.size());
  evidence.right_features = static_cast<int>(right.points.size());
  evidence.block_share = block_agreement(pair.left, pair.right, least_block_share).share;
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
  constexpr double least_share = 0.02;
  const PairEvidence evidence = pair_evidence(pair);
  const int features = std::min(evidence.left_features, evidence.right_features);
  if (features < least_features) return false;
  const bool features_fit = evidence.inliers >= least_inliers && evidence.inliers >= least_share * features;
  return !features_fit && evidence.block_share < least_block_share;
}

}  // namespace wheatstone
