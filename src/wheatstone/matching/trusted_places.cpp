#include "wheatstone/matching/trusted_places_internal.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_internal.h"

namespace wheatstone {
namespace {

/// The deviation in the plainest parts of a picture: its noise, where it has any plain part.
float noise_of(const cv::Mat& deviation) {
  constexpr double plainest = 0.1, sampled = 0.25;
  const cv::Mat small = shrunk(deviation, sampled, cv::INTER_NEAREST);
  std::vector<float> values(small.begin<float>(), small.end<float>());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(plainest * static_cast<double>(values.size()));
  std::ranges::nth_element(values, at);
  return *at;
}

/// Both masks as far as single pixels and their windows tell, and what the noise is told from.
struct LocalEvidence {
  cv::Mat deviation;  ///< of grey levels in a window around each pixel
  cv::Mat distinct, no_better;
};

constexpr int plain_window_px = 7;

/// Filters read beyond a band's rows, which are a part of the whole picture.
void find_deviation(const cv::Mat& grey, cv::Mat deviation) {
  const cv::Size window(plain_window_px, plain_window_px);
  cv::Mat mean, mean_square;
  cv::boxFilter(grey, mean, CV_32F, window);
  cv::sqrBoxFilter(grey, mean_square, CV_32F, window);
  cv::sqrt(cv::max(mean_square - mean.mul(mean), 0), deviation);
}

/// The cost at the disparity that was chosen, as a share of the mean of all: near 1 where none is better than another.
cv::Mat cost_share(const cv::Mat& own_cost, const cv::Mat& mean_cost) {
  constexpr int window_px = 9;
  cv::Mat own, mean;
  cv::boxFilter(own_cost, own, CV_32F, {window_px, window_px});
  cv::boxFilter(mean_cost, mean, CV_32F, {window_px, window_px});
  constexpr double none = 0.01;  // where nothing costs anything, as in black, no disparity is better than another
  return (own + none) / (mean + none);
}

LocalEvidence local_evidence(const cv::Mat& picture, const BandMatch& match) {
  constexpr double clearly_better = 0.7, hardly_better = 0.6;
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  const cv::Mat own = as_mat(match.own_cost), mean = as_mat(match.mean_cost);
  LocalEvidence evidence{cv::Mat(picture.size(), CV_32F), cv::Mat(picture.size(), CV_8U),
                         cv::Mat(picture.size(), CV_8U)};
  for_each_band(picture.rows, [&](const cv::Range& rows) {
    find_deviation(grey.rowRange(rows), evidence.deviation.rowRange(rows));
    const cv::Mat share = cost_share(own.rowRange(rows), mean.rowRange(rows));
    cv::Mat distinct = evidence.distinct.rowRange(rows), no_better = evidence.no_better.rowRange(rows);
    cv::compare(share, clearly_better, distinct, cv::CMP_LT);
    cv::compare(share, hardly_better, no_better, cv::CMP_GT);
  });
  return evidence;
}

}  // namespace

TrustedPlaces trusted_places(const cv::Mat& picture, const BandMatch& match) {
  constexpr float above_noise = 1.6f, least_limit = 1.2f, largest_limit = 3;
  const LocalEvidence evidence = local_evidence(picture, match);
  const float limit = std::clamp(above_noise * noise_of(evidence.deviation), least_limit, largest_limit);
  cv::Mat plain = (evidence.deviation < limit) & evidence.no_better;

  // Small plain places are carried by what surrounds them; large ones are not.
  constexpr int large_share = 8;  // of the width
  constexpr double mostly = 0.8 * 255;
  const int large_px = std::max(picture.cols / large_share, plain_window_px) | 1;
  // Twice the rows reach all of them from everywhere; filters take time and memory for each row of their windows.
  const cv::Size window(large_px, std::min(large_px, 2 * picture.rows - 1));
  cv::Mat large;
  cv::boxFilter(plain, large, -1, window);
  large = large > mostly;
  cv::dilate(large, large, cv::getStructuringElement(cv::MORPH_RECT, window));
  plain &= large;
  cv::dilate(plain, plain, cv::getStructuringElement(cv::MORPH_RECT, {plain_window_px, plain_window_px}));
  constexpr double least_noise = 0.5;
  return {plain, evidence.distinct, evidence.deviation < least_noise};
}

}  // namespace wheatstone
