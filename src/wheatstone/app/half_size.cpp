#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/app/half_size_internal.h"
#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/relief.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {
namespace {

Image<Rgb8> at_half_size(const Image<Rgb8>& picture) {
  if (picture.empty()) return {};
  const int odd_columns = picture.width() % 2, odd_rows = picture.height() % 2;
  if (odd_columns == 0 && odd_rows == 0) return reduced(picture, {picture.width() / 2, picture.height() / 2});
  Image<Rgb8> even(picture.width() + odd_columns, picture.height() + odd_rows);
  cv::Mat target = as_mat(even);
  cv::copyMakeBorder(as_mat(picture), target, 0, odd_rows, 0, odd_columns, cv::BORDER_REPLICATE);
  return reduced(even, {even.width() / 2, even.height() / 2});
}

}  // namespace

bool may_be_planned_at_half_size(const Style& style, int width) {
  constexpr float least_radius_px = 3;
  return is_of_strokes(style) && ScaledStyle(style, width).radii_px.back() >= least_radius_px;
}

Style at_half_size(Style style) {
  if (!style.absolute_radii) return style;
  for (float& radius : style.radii_px) radius /= 2;
  style.depth_threshold_px /= 2;
  return style;
}

StereoPair at_half_size(const StereoPair& eyes) { return {at_half_size(eyes.left), at_half_size(eyes.right)}; }

DisparityRange at_half_size(const DisparityRange& range) {
  const auto half = [](int disparity) { return floor_of(static_cast<float>(disparity) / 2); };
  return {half(range.least), -half(-range.largest)};
}

Painting at_whole_size(Painting painting, PictureSize frame, const Style& style) {
  Painting whole = placed(std::move(painting), {.width = frame.width, .height = frame.height, .scale = 2});
  whole.relief = relief_for(style, frame.width);
  return whole;
}

}  // namespace wheatstone
