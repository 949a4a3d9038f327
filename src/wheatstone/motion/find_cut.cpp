#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/motion/flow.h"

namespace wheatstone {
namespace {

constexpr int small_px = 240;  ///< the longer side of the pictures that are compared

// Between what films measure at their cuts (find_cut_test.cpp: 0.46 to 0.79, and 0.01 to 0.54) and elsewhere (at most
// 0.04, and at least 0.88).
constexpr double least_histogram_distance = 0.2;
constexpr double most_confirmed_share = 0.7;

Image<Rgb8> shrunk_to_compare(ImageView<const Rgb8> picture) {
  const double scale = std::min(1.0, static_cast<double>(small_px) / std::max(picture.width(), picture.height()));
  const auto side = [&](int px) { return std::max(static_cast<int>(std::lround(px * scale)), 16); };
  Image<Rgb8> small(side(picture.width()), side(picture.height()));
  cv::Mat target = as_mat(small);
  cv::resize(as_mat(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  return small;
}

/// How many pixels have each of 8³ colours.
std::vector<int> histogram(const Image<Rgb8>& picture) {
  std::vector<int> counts(std::size_t{8} * 8 * 8);
  for (const Rgb8 pixel : picture.pixels())
    ++counts[static_cast<std::size_t>((pixel.r >> 5) << 6 | (pixel.g >> 5) << 3 | pixel.b >> 5)];
  return counts;
}

double histogram_distance(const Image<Rgb8>& first, const Image<Rgb8>& second) {
  const std::vector<int> a = histogram(first), b = histogram(second);
  int differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differing += std::abs(a[i] - b[i]);
  return 0.5 * differing / static_cast<double>(first.pixels().size());
}

}  // namespace

FrameChange find_cut(ImageView<const Rgb8> first, ImageView<const Rgb8> second) {
  if (!same_size(first, second) || first.empty())
    throw Error(ErrorKind::bad_input,
                "the frames are empty or differ in size, expected two frames of one size for cut detection");
  const Image<Rgb8> a = shrunk_to_compare(first), b = shrunk_to_compare(second);
  FrameChange change;
  change.histogram_distance = histogram_distance(a, b);
  change.flow = estimate_flow(a, b);
  const Image<std::uint8_t> mask = confirmed(change.flow.forward, change.flow.backward);
  const auto count = std::ranges::count(mask.pixels(), 255);
  change.confirmed_share = static_cast<double>(count) / static_cast<double>(mask.pixels().size());
  change.cut = change.histogram_distance > least_histogram_distance && change.confirmed_share < most_confirmed_share;
  return change;
}

}  // namespace wheatstone
