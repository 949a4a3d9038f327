#include "wheatstone/measures/painting_likeness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// The painting in the photograph's size.
cv::Mat in_size_of(ImageView<const Rgb8> photograph, ImageView<const Rgb8> painting) {
  if (photograph.empty() || painting.empty())
    throw Error(ErrorKind::bad_input, "an empty picture, expected a photograph and its painting");
  constexpr double tolerance = 0.02;
  const double shape = static_cast<double>(photograph.width()) / photograph.height();
  if (std::abs(static_cast<double>(painting.width()) / painting.height() / shape - 1) > tolerance)
    throw Error(ErrorKind::bad_input,
                fmt::format("the painting is {}x{} pixels, expected the shape of the photograph's "
                            "{}x{}",
                            painting.width(), painting.height(), photograph.width(), photograph.height()));
  cv::Mat sized;
  cv::resize(as_mat(painting), sized, {photograph.width(), photograph.height()}, 0, 0, cv::INTER_AREA);
  return sized;
}

cv::Mat luminance_of(const cv::Mat& picture) {
  cv::Mat grey, luminance;
  cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(luminance, CV_64F);
  return luminance;
}

/// The channels L*, a*, b*.
std::array<cv::Mat, 3> lab_of(const cv::Mat& picture) {
  std::array<cv::Mat, 3> channels;
  cv::split(cielab_of(picture), channels.data());
  return channels;
}

/// Blurred by a Gaussian that is cut off at four standard deviations.
cv::Mat blurred(const cv::Mat& picture, double deviation_px) {
  const int reach = static_cast<int>(4 * deviation_px + 0.5);
  cv::Mat result;
  cv::GaussianBlur(picture, result, {2 * reach + 1, 2 * reach + 1}, deviation_px, deviation_px, cv::BORDER_REFLECT);
  return result;
}

/// Every second row and column.
cv::Mat every_second(const cv::Mat& picture) {
  cv::Mat result((picture.rows + 1) / 2, (picture.cols + 1) / 2, CV_64F);
  for (int y = 0; y < result.rows; ++y)
    for (int x = 0; x < result.cols; ++x) result.at<double>(y, x) = picture.at<double>(2 * y, 2 * x);
  return result;
}

/// Prewitt's gradient magnitude of a picture of half the size (Xue et al. 2014, eq. 1 to 3).
cv::Mat gradient_magnitude(const cv::Mat& luminance) {
  cv::Mat averaged, along_x, along_y, magnitude;
  cv::blur(luminance, averaged, {2, 2});
  const cv::Mat half = every_second(averaged);
  const cv::Mat prewitt = (cv::Mat_<double>(3, 3) << 1, 0, -1, 1, 0, -1, 1, 0, -1) / 3;
  cv::filter2D(half, along_x, -1, prewitt);
  cv::filter2D(half, along_y, -1, prewitt.t());
  cv::magnitude(along_x, along_y, magnitude);
  return magnitude;
}

/// (2ab + c) / (a² + b² + c) of gradient magnitudes a and b (Xue et al. 2014, eq. 4).
cv::Mat similarity_of(const cv::Mat& photograph, const cv::Mat& painting) {
  constexpr double c = 170;
  const cv::Mat a = gradient_magnitude(photograph), b = gradient_magnitude(painting);
  const cv::Mat numerator = 2 * a.mul(b) + c, denominator = a.mul(a) + b.mul(b) + c;
  return numerator / denominator;
}

/// The standard deviation of luminance about each pixel, and its mean.
struct Contrast {
  cv::Mat deviation, mean;
};

Contrast local_contrast(const cv::Mat& luminance) {
  constexpr double around_px = 5;
  Contrast contrast{{}, blurred(luminance, around_px)};
  const cv::Mat variance = blurred(luminance.mul(luminance), around_px) - contrast.mean.mul(contrast.mean);
  cv::sqrt(cv::max(variance, 0), contrast.deviation);
  return contrast;
}

/// The value below which a share of the values lie, interpolated between neighbours in order.
double quantile(const cv::Mat& values, double share) {
  std::vector<double> sorted(values.begin<double>(), values.end<double>());
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = sorted.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(sorted, below);
  const auto above = std::min_element(below + 1, sorted.end());
  if (above == sorted.end()) return *below;
  return *below + (place - std::floor(place)) * (*above - *below);
}

double colour_distance(const std::array<cv::Mat, 3>& photograph, const std::array<cv::Mat, 3>& painting) {
  constexpr double blur_px = 2;
  cv::Mat squares = cv::Mat::zeros(photograph[0].size(), CV_32F);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const cv::Mat difference = blurred(photograph[channel], blur_px) - blurred(painting[channel], blur_px);
    squares += difference.mul(difference);
  }
  cv::Mat distance;
  cv::sqrt(squares, distance);
  return cv::mean(distance)[0];
}

/// The weighted mean of the structure tensor's coherence, √((xx − yy)² + 4xy²) / (xx + yy), by the energy xx + yy.
double coherence(const cv::Mat& fine, const cv::Mat& mask) {
  constexpr double around_px = 4;
  cv::Mat along_x, along_y, root;
  cv::Sobel(fine, along_x, -1, 1, 0);
  cv::Sobel(fine, along_y, -1, 0, 1);
  const cv::Mat xx = blurred(along_x.mul(along_x), around_px), yy = blurred(along_y.mul(along_y), around_px);
  const cv::Mat xy = blurred(along_x.mul(along_y), around_px), difference = xx - yy;
  cv::sqrt(difference.mul(difference) + 4 * xy.mul(xy), root);
  // The energy cancels: the mean of root / energy, weighted by energy.
  const double energy = cv::mean(xx + yy, mask)[0];
  constexpr double least_energy = 1e-9;
  return energy > least_energy ? cv::mean(root, mask)[0] / energy : 0;
}

}  // namespace

PaintingLikeness measure_likeness(ImageView<const Rgb8> photograph, ImageView<const Rgb8> painting) {
  const cv::Mat source = as_mat(photograph), paint = in_size_of(photograph, painting);
  const cv::Mat luminance = luminance_of(source);
  const cv::Mat similarity = similarity_of(luminance, luminance_of(paint));
  const Contrast contrast = local_contrast(luminance);

  constexpr double detailed_share = 0.9, plain_share = 0.3, darkest = 10;
  const cv::Mat detail = every_second(contrast.deviation / (contrast.mean + darkest));
  const cv::Mat is_detailed = detail >= quantile(detail, detailed_share);
  const cv::Mat is_plain = contrast.deviation <= quantile(contrast.deviation, plain_share);

  const std::array<cv::Mat, 3> painted_lab = lab_of(paint);
  constexpr double fine_px = 2;
  cv::Mat fine;
  cv::Mat(painted_lab[0] - blurred(painted_lab[0], fine_px)).convertTo(fine, CV_64F);
  return {.gms = cv::mean(similarity)[0],
          .gms_detail = cv::mean(similarity, is_detailed)[0],
          .lab = colour_distance(lab_of(source), painted_lab),
          .grain = cv::mean(cv::abs(fine), is_plain)[0],
          .streaks = coherence(fine, is_plain)};
}

std::vector<double> measure_faces(ImageView<const Rgb8> photograph, ImageView<const Rgb8> painting,
                                  const std::vector<PixelBox>& faces) {
  const cv::Mat source = as_mat(photograph), paint = in_size_of(photograph, painting);
  std::vector<double> similarities;
  for (const PixelBox& face : faces) {
    constexpr int compared_px = 160;
    const auto cut = [&](const cv::Mat& picture) {
      cv::Mat grey, sized;
      cv::cvtColor(picture(cv::Rect(face.left, face.top, face.width, face.height)), grey, cv::COLOR_RGB2GRAY);
      cv::resize(grey, sized, {compared_px, compared_px}, 0, 0, cv::INTER_AREA);
      sized.convertTo(sized, CV_64F);
      return sized;
    };
    similarities.push_back(cv::mean(similarity_of(cut(source), cut(paint)))[0]);
  }
  return similarities;
}

}  // namespace wheatstone
