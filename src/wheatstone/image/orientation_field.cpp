#include "wheatstone/image/orientation_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// Gradients below this many luminance steps a pixel are counted as noise.
constexpr float strong_gradient = 4;
/// How much the field weighs against the gradient at the point itself.
constexpr float field_weight = 0.1f;

/// Four channels a pixel: the tensor's xx, xy, yy, each times the weight, and the weight.
cv::Mat weighted_tensors(const cv::Mat& luminance, float steps_per_picture_px) {
  cv::Mat gradient_x, gradient_y;
  const double sobel_scale = 1.0 / 8 * steps_per_picture_px;
  cv::Sobel(luminance, gradient_x, CV_32F, 1, 0, 3, sobel_scale);
  cv::Sobel(luminance, gradient_y, CV_32F, 0, 1, 3, sobel_scale);
  cv::Mat tensors(luminance.size(), CV_32FC4);
  for (int y = 0; y < tensors.rows; ++y) {
    const float* gx = gradient_x.ptr<float>(y);
    const float* gy = gradient_y.ptr<float>(y);
    cv::Vec4f* to = tensors.ptr<cv::Vec4f>(y);
    for (int x = 0; x < tensors.cols; ++x) {
      const float energy = gx[x] * gx[x] + gy[x] * gy[x];
      const float weight = energy / (energy + strong_gradient * strong_gradient);
      to[x] = cv::Vec4f(gx[x] * gx[x], gx[x] * gy[x], gy[x] * gy[x], 1) * weight;
    }
  }
  return tensors;
}

/// How much more a tensor points one way than noise alone would, 0..1.
float clear_coherence(const cv::Vec4f& tensor, float of_noise) {
  const float across = tensor[0] - tensor[2], aslant = 2 * tensor[1], sum = tensor[0] + tensor[2];
  const float coherence = std::sqrt(across * across + aslant * aslant) / std::max(sum, 1e-12f);
  return std::max(coherence - of_noise, 0.f) / (1 - of_noise);
}

/// Normalised convolution over a pyramid: each level speaks where it has weight, the coarser ones elsewhere. What is
/// weak counts where it points one way: noise does not, and a faint slope does.
cv::Mat interpolate(const cv::Mat& finest) {
  std::vector<cv::Mat> levels{finest};
  while (std::min(levels.back().rows, levels.back().cols) > 2) {
    cv::Mat coarser;
    cv::pyrDown(levels.back(), coarser);
    levels.push_back(coarser);
  }
  // Noise points one way about as much as this in the finest level, and half as much in each coarser one, which takes
  // the mean of four times as many.
  constexpr float full_confidence = 0.25f, weak = 0.1f, finest_of_noise = 0.6f;
  // Where there is nothing but faint noise strokes lie level, as on a slope of 1/17 step a pixel from top to bottom.
  constexpr double level_ground = 2e-5;
  cv::Mat field;
  for (std::size_t finer_levels = levels.size(); finer_levels-- > 0;) {
    const cv::Mat& level = levels[finer_levels];
    const float of_noise = std::ldexp(finest_of_noise, -static_cast<int>(finer_levels));
    cv::Mat coarser_field;
    if (field.empty()) {
      coarser_field = cv::Mat(level.size(), CV_32FC4, cv::Scalar(0, 0, level_ground, 0));
    } else {
      cv::pyrUp(field, coarser_field, level.size());
    }
    field.create(level.size(), CV_32FC4);
    for (int y = 0; y < field.rows; ++y) {
      const cv::Vec4f* own = level.ptr<cv::Vec4f>(y);
      const cv::Vec4f* coarse = coarser_field.ptr<cv::Vec4f>(y);
      cv::Vec4f* to = field.ptr<cv::Vec4f>(y);
      for (int x = 0; x < field.cols; ++x) {
        const float weight = own[x][3];
        const float strength = std::min(weight / full_confidence, 1.f);
        const float confidence = strength * std::max(std::min(strength / weak, 1.f), clear_coherence(own[x], of_noise));
        const cv::Vec4f mean = own[x] * (1 / std::max(weight, 1e-6f));
        to[x] = mean * confidence + coarse[x] * (1 - confidence);
      }
    }
  }
  return field;
}

}  // namespace

OrientationField::OrientationField(ImageView<const std::uint8_t> luminance, float detail_px)
    : scale_(1 / std::max(detail_px, 1.f)) {
  const int width = std::max(static_cast<int>(static_cast<float>(luminance.width()) * scale_), 1);
  const int height = std::max(static_cast<int>(static_cast<float>(luminance.height()) * scale_), 1);
  cv::Mat reduced;
  cv::resize(as_mat(luminance), reduced, {width, height}, 0, 0, cv::INTER_AREA);
  // A first blur spreads each gradient a little, so that neighbouring strokes agree.
  cv::Mat tensors = weighted_tensors(reduced, scale_);
  cv::GaussianBlur(tensors, tensors, {}, 1.5);
  const cv::Mat field = interpolate(tensors);

  xx_ = Image<float>(width, height);
  xy_ = Image<float>(width, height);
  yy_ = Image<float>(width, height);
  cv::Mat planes[] = {as_mat(xx_), as_mat(xy_), as_mat(yy_)};
  const int from_to[] = {0, 0, 1, 1, 2, 2};
  cv::mixChannels(&field, 1, planes, 3, from_to, 3);
}

void OrientationField::round() {
  constexpr std::uint32_t left_out = (1u << 16) - 1;  // of the mantissa's 23 bits
  for (Image<float>* const plane : {&xx_, &xy_, &yy_})
    for (float& value : plane->pixels())
      value = std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) + left_out / 2) & ~left_out);
}

Direction OrientationField::along(float x, float y, float gradient_x, float gradient_y) const {
  const float field_x = std::clamp(x * scale_ - 0.5f, 0.f, static_cast<float>(xx_.width() - 1));
  const float field_y = std::clamp(y * scale_ - 0.5f, 0.f, static_cast<float>(xx_.height() - 1));
  const int x0 = static_cast<int>(field_x), y0 = static_cast<int>(field_y);
  const int x1 = std::min(x0 + 1, xx_.width() - 1), y1 = std::min(y0 + 1, xx_.height() - 1);
  const float u = field_x - static_cast<float>(x0), v = field_y - static_cast<float>(y0);
  const auto sample = [&](const Image<float>& plane) {
    return (1 - v) * ((1 - u) * plane(x0, y0) + u * plane(x1, y0)) + v * ((1 - u) * plane(x0, y1) + u * plane(x1, y1));
  };
  const float xx = gradient_x * gradient_x + field_weight * sample(xx_);
  const float xy = gradient_x * gradient_y + field_weight * sample(xy_);
  const float yy = gradient_y * gradient_y + field_weight * sample(yy_);
  // The tensor's larger eigenvector points up the gradient, at half the angle of (xx − yy, 2xy); strokes run across.
  const float across = xx - yy, aslant = 2 * xy, length = std::sqrt(across * across + aslant * aslant);
  if (xx + yy <= 0) return {};
  if (length == 0) return {0, 1};
  const float larger = std::sqrt(0.5f * (1 + std::abs(across) / length));
  const float smaller = std::abs(aslant) / (2 * length * larger);
  return across >= 0 ? Direction{-std::copysign(smaller, aslant), larger}
                     : Direction{-std::copysign(larger, aslant), smaller};
}

}  // namespace wheatstone
