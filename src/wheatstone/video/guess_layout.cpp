#include "wheatstone/video/guess_layout_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

constexpr int columns = 160;            // of a half, when compared
constexpr double most_shift = 0.08;     // of the half's width
constexpr double least_contrast = 1.5;  // grey levels: a flat half correlates with anything
constexpr double enough = 0.55;

/// A half of the frame, grey and small, without what varies slowly: skies and vignettes are alike in any two halves.
cv::Mat details_of(const cv::Mat& half) {
  const double scale = std::min(1.0, static_cast<double>(columns) / half.cols);
  const int rows = std::max(4, static_cast<int>(std::lround(half.rows * scale)));
  cv::Mat small, grey, smooth;
  cv::resize(half, small, {std::max(4, static_cast<int>(std::lround(half.cols * scale))), rows}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(grey, CV_32F);
  // A pixel of blur forgives half a row or column of misalignment.
  cv::GaussianBlur(grey, grey, {}, 1.0);
  cv::GaussianBlur(grey, smooth, {}, 12.0);
  return grey - smooth;
}

/// The correlation −1..1 of two halves under the best sideways shift; nothing where one is flat.
std::optional<double> likeness(const cv::Mat& first, const cv::Mat& second) {
  const cv::Mat a = details_of(first), b = details_of(second);
  const int reach = std::max(1, static_cast<int>(a.cols * most_shift));
  double best = -1;
  for (int shift = -reach; shift <= reach; ++shift) {
    const int width = a.cols - std::abs(shift);
    const cv::Mat left = a.colRange(std::max(0, shift), std::max(0, shift) + width);
    const cv::Mat right = b.colRange(std::max(0, -shift), std::max(0, -shift) + width);
    const double size = std::sqrt(left.dot(left) * right.dot(right));
    if (size < least_contrast * least_contrast * static_cast<double>(left.total())) continue;
    best = std::max(best, left.dot(right) / size);
  }
  if (best < -0.99) return {};
  return best;
}

struct Likenesses {
  double side_by_side = 0;
  double over_under = 0;
  int frames = 0;
};

Likenesses likenesses_of(std::span<const Image<Rgb8>> frames) {
  Likenesses sums;
  for (const Image<Rgb8>& frame : frames) {
    if (frame.width() < 16 || frame.height() < 16) continue;
    const cv::Mat picture = as_mat(frame);
    const int half_width = picture.cols / 2, half_height = picture.rows / 2;
    const auto beside =
        likeness(picture.colRange(0, half_width), picture.colRange(picture.cols - half_width, picture.cols));
    const auto above =
        likeness(picture.rowRange(0, half_height), picture.rowRange(picture.rows - half_height, picture.rows));
    if (!beside && !above) continue;
    sums.side_by_side += beside.value_or(0);
    sums.over_under += above.value_or(0);
    ++sums.frames;
  }
  sums.side_by_side /= std::max(1, sums.frames);
  sums.over_under /= std::max(1, sums.frames);
  return sums;
}

}  // namespace

GuessedLayout guess_layout(std::span<const Image<Rgb8>> frames) {
  const Likenesses found = likenesses_of(frames);
  if (found.frames == 0) return {StereoLayout::mono, "the frames are too flat or too small to tell"};
  const double best = std::max(found.side_by_side, found.over_under);
  if (best < enough) {
    return {StereoLayout::mono, fmt::format("no two halves are alike (side by side {:.2f}, one above the other {:.2f})",
                                            found.side_by_side, found.over_under)};
  }
  const Image<Rgb8>& frame = frames.front();
  const double proportions = static_cast<double>(frame.width()) / frame.height();
  if (found.side_by_side >= found.over_under) {
    const bool half = proportions / 2 < 0.95;
    return {half ? StereoLayout::left_right_half : StereoLayout::left_right,
            fmt::format("the left and right halves are alike ({:.2f}){}; the left eye is assumed on the left", best,
                        half ? " and narrow, and therefore squeezed" : "")};
  }
  const bool half = proportions * 2 > 2.4;
  return {half ? StereoLayout::top_bottom_half : StereoLayout::top_bottom,
          fmt::format("the upper and lower halves are alike ({:.2f}){}; the left eye is assumed on top", best,
                      half ? " and very wide, and therefore squeezed" : "")};
}

}  // namespace wheatstone
