#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>

#include "wheatstone/matching/match.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// OpenCV's matchers count disparities in sixteenths of a pixel.
inline constexpr int sixteenths_a_px = 16;

/// Disparity of a pixel of which nothing is known.
inline constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// The rows of a band, but for the last one.
inline constexpr int rows_a_band = 64;

/// Calls `work` with the rows of every band of a picture, on all processors. Filters that take a border, as
/// cv::boxFilter does, read the rows beside a band of a whole picture; cv::medianBlur does not.
template <class Work>
void for_each_band(int rows, const Work& work) {
  tbb::parallel_for(0, (rows + rows_a_band - 1) / rows_a_band,
                    [&](int band) { work(cv::Range(band * rows_a_band, std::min((band + 1) * rows_a_band, rows))); });
}

/// Disparity of the first of two 8-bit RGB pictures, in pixels, NaN where nothing was found. One way, unchecked.
Image<float> match_with_opencv(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range,
                               const MatchOptions& options);

/// The same by dynamic programming, for two luminance pictures: CV_8UC1.
Image<float> match_scan_lines(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range);

/// The same by the network in `options.model`. Throws Error{bad_input}.
Image<float> match_with_network(const cv::Mat& own, const cv::Mat& other, const MatchOptions& options);

/// Disparities of a pair, in its pixels, as far as few and sure matches show them.
struct SeenDisparities {
  float least = 0, largest = 0;
};

/// None where the pair gives nothing to go by.
std::optional<SeenDisparities> find_seen_disparities(const StereoPair& pair);

}  // namespace wheatstone
