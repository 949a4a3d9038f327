#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/binary_descriptors_internal.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/trusted_places_internal.h"

namespace wheatstone {
namespace {

/// Corners are looked for in pictures at most this wide: enough for a range, and quick.
constexpr int search_width_px = 1000;
constexpr std::size_t least_matches = 12;

/// Dense disparities of a small copy of the pair, over all that a picture could hold: it also sees surfaces on which
/// there are no corners. What is plain tells nothing, what is small may be chance. In pixels of the full picture; none
/// where too little is sure.
std::vector<float> coarse_disparities(const StereoPair& pair) {
  constexpr int reduced_width_px = 320, least_surface_px = 60;
  constexpr double least_share = 0.01;
  const double scale = std::min(1.0, static_cast<double>(reduced_width_px) / pair.left.width());
  const cv::Mat left = shrunk(as_mat(pair.left), scale), right = shrunk(as_mat(pair.right), scale);
  const SearchBand band{Image<std::int16_t>(left.cols, left.rows, static_cast<std::int16_t>(-left.cols / 6)),
                        left.cols / 6 + left.cols / 3 + 1};
  const BandMatch match = match_semi_global(left, right, band);
  Image<float> sure = confirmed_disparity(match.left, match.right, -1, 1);
  const TrustedPlaces places = trusted_places(left, match);
  as_mat(sure).setTo(unknown, places.plain | places.blank | ~places.distinct);
  remove_speckles(sure, least_surface_px);
  if (known_share(sure) < least_share) return {};
  return {disparity_percentile(sure, 0.01) / static_cast<float>(scale),
          disparity_percentile(sure, 0.995) / static_cast<float>(scale)};
}

cv::Mat reduced_luminance(const Image<Rgb8>& picture, double scale) {
  cv::Mat luminance;
  cv::cvtColor(as_mat(picture), luminance, cv::COLOR_RGB2GRAY);
  return scale < 1 ? shrunk(luminance, scale) : luminance;
}

/// Disparities of corners that are each other's best match and lie on one scan line.
std::vector<float> sparse_disparities(const cv::Mat& left, const cv::Mat& right) {
  constexpr int corners = 3000;
  constexpr float largest_offset_px = 1.5f;
  const auto orb = cv::ORB::create(corners);
  orb->setFastThreshold(8);
  // Nearer to an edge there are no corners, and of a strip the pyramid has levels without rows.
  if (std::min({left.cols, left.rows, right.cols, right.rows}) <= 2 * orb->getEdgeThreshold()) return {};
  std::vector<cv::KeyPoint> left_corners, right_corners;
  cv::Mat left_descriptors, right_descriptors;
  orb->detectAndCompute(left, {}, left_corners, left_descriptors);
  orb->detectAndCompute(right, {}, right_corners, right_descriptors);
  std::vector<float> disparities;
  if (left_corners.empty() || right_corners.empty()) return disparities;
  constexpr int largest_distance_bits = 48;
  for (const BinaryMatch& match : match_binary_descriptors(left_descriptors, right_descriptors)) {
    const cv::Point2f offset = left_corners[match.left].pt - right_corners[match.right].pt;
    if (match.distance_bits <= largest_distance_bits && std::abs(offset.y) <= largest_offset_px)
      disparities.push_back(offset.x);
  }
  return disparities;
}

/// Drops what too few others agree with: chance matches on a scan line are spread over the whole width.
std::vector<float> supported(std::vector<float> disparities, float agreement_px) {
  std::ranges::sort(disparities);
  constexpr std::size_t least_neighbours = 3;
  std::vector<float> kept;
  for (std::size_t i = 0; i < disparities.size(); ++i) {
    const auto low = std::ranges::lower_bound(disparities, disparities[i] - agreement_px);
    const auto high = std::ranges::upper_bound(disparities, disparities[i] + agreement_px);
    if (static_cast<std::size_t>(high - low) > least_neighbours) kept.push_back(disparities[i]);
  }
  return kept;
}

}  // namespace

std::optional<SeenDisparities> find_seen_disparities(const StereoPair& pair) {
  const double scale = std::min(1.0, static_cast<double>(search_width_px) / pair.left.width());
  std::vector<float> ends, corners;
  tbb::parallel_invoke([&] { ends = coarse_disparities(pair); },
                       [&] {
                         const cv::Mat left = reduced_luminance(pair.left, scale),
                                       right = reduced_luminance(pair.right, scale);
                         const float agreement_px = std::max(2.f, 0.005f * static_cast<float>(left.cols));
                         corners = supported(sparse_disparities(left, right), agreement_px);
                       });
  if (corners.size() >= least_matches) {
    ends.push_back(corners.front() / static_cast<float>(scale));
    ends.push_back(corners.back() / static_cast<float>(scale));
  }
  if (ends.empty()) return {};
  const auto [least, largest] = std::ranges::minmax(ends);
  return SeenDisparities{least, largest};
}

DisparityRange usual_disparity_range(int width_px) { return {-width_px / 32, std::max(width_px / 8, 16)}; }

std::optional<DisparityRange> find_disparity_range(const StereoPair& pair) {
  const std::optional<SeenDisparities> seen = find_seen_disparities(pair);
  if (!seen) return {};
  const float room = std::max(0.1f * (seen->largest - seen->least), 6.f);
  const int limit = pair.left.width() - 1;
  return DisparityRange{std::max(static_cast<int>(std::floor(seen->least - room)), -limit),
                        std::min(static_cast<int>(std::ceil(seen->largest + room)), limit)};
}

}  // namespace wheatstone
