#include "wheatstone/stereo/retouch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// How much a touch does at a distance from its middle, 0..1.
float share_at(float distance_px, float radius_px) {
  const float share = std::clamp(2 - 2 * distance_px / radius_px, 0.f, 1.f);
  return share * share * (3 - 2 * share);
}

/// The pixels within a touch's square that lie in a map.
cv::Rect square_of(const Touch& touch, int width, int height) {
  const auto place = [](float at, int size) {
    return static_cast<int>(std::clamp(std::floor(at), 0.f, static_cast<float>(size)));
  };
  const int left = place(touch.x - touch.radius_px, width), right = place(touch.x + touch.radius_px + 1, width);
  const int top = place(touch.y - touch.radius_px, height), bottom = place(touch.y + touch.radius_px + 1, height);
  return {left, top, right - left, bottom - top};
}

/// Replaces each value under a touch by `change(value, share, x, y)`.
template <class Value, class Change>
void brush_over(const Touch& touch, Image<Value>& map, Change change) {
  const cv::Rect square = square_of(touch, map.width(), map.height());
  for (int y = square.y; y < square.y + square.height; ++y) {
    for (int x = square.x; x < square.x + square.width; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - touch.x, dy = static_cast<float>(y) + 0.5f - touch.y;
      const float share = share_at(std::hypot(dx, dy), touch.radius_px);
      if (share > 0) map(x, y) = change(map(x, y), share, x, y);
    }
  }
}

void smooth(const Touch& touch, Image<float>& disparity) {
  const cv::Rect square = square_of(touch, disparity.width(), disparity.height());
  if (square.empty()) return;
  // OpenCV reads on beyond a part of a matrix: what lies beside the square takes part in the means.
  cv::Mat mean;
  cv::GaussianBlur(as_mat(disparity)(square), mean, {}, static_cast<double>(touch.amount), 0, cv::BORDER_REPLICATE);
  brush_over(touch, disparity, [&](float value, float share, int x, int y) {
    return value + share * (mean.at<float>(y - square.y, x - square.x) - value);
  });
}

void fill(const Touch& touch, ImageView<const Rgb8> picture, Image<float>& disparity) {
  constexpr int from_neighbour = 6;
  constexpr int from_begin = 40;
  const cv::Point begin(static_cast<int>(std::floor(touch.x)), static_cast<int>(std::floor(touch.y)));
  if (!cv::Rect(0, 0, picture.width(), picture.height()).contains(begin)) return;
  // Noise would cut a sky into pieces.
  cv::Mat steady;
  cv::medianBlur(as_mat(picture), steady, 5);
  cv::Mat connected(picture.height() + 2, picture.width() + 2, CV_8U, cv::Scalar(0)), like_begin = connected.clone();
  const int how = 4 | (255 << 8) | cv::FLOODFILL_MASK_ONLY;
  cv::floodFill(steady, like_begin, begin, {}, nullptr, cv::Scalar::all(from_begin), cv::Scalar::all(from_begin),
                how | cv::FLOODFILL_FIXED_RANGE);
  connected.setTo(1, like_begin == 0);  // pixels that are not 0 are not filled
  cv::floodFill(steady, connected, begin, {}, nullptr, cv::Scalar::all(from_neighbour), cv::Scalar::all(from_neighbour),
                how);
  const cv::Mat filled = connected(cv::Rect(1, 1, picture.width(), picture.height())) == 255;
  // The specks that it left out, and the pixels at its rim in which both colours mix.
  cv::Mat closed;
  cv::morphologyEx(filled, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  as_mat(disparity).setTo(static_cast<double>(touch.amount), closed);
}

/// How many touches belong to the stroke of the hand that the first one begins.
std::size_t touches_of_hand(std::span<const Touch> touches) {
  std::size_t count = 1;
  while (count < touches.size() && touches[count].goes_on && touches[count].kind == touches[0].kind) ++count;
  return count;
}

/// Replaces each value in the area that touches go around by `change(value)`.
template <class Change>
void change_area(std::span<const Touch> around, Image<float>& disparity, Change change) {
  if (around.size() < 3) return;  // a point, or a line
  constexpr int fraction_bits = 4;
  constexpr float steps_a_px = 1 << fraction_bits;
  std::vector<cv::Point> corners;
  // OpenCV has the middles of pixels at whole numbers.
  for (const Touch& touch : around)
    corners.emplace_back(cv::saturate_cast<int>((touch.x - 0.5f) * steps_a_px),
                         cv::saturate_cast<int>((touch.y - 0.5f) * steps_a_px));
  cv::Mat inside(disparity.height(), disparity.width(), CV_8U, cv::Scalar(0));
  cv::fillPoly(inside, std::vector{corners}, cv::Scalar(255), cv::LINE_8, fraction_bits);
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x)
      if (inside.at<std::uint8_t>(y, x) != 0) disparity(x, y) = change(disparity(x, y));
}

}  // namespace

void retouch_disparity(std::span<const Touch> touches, ImageView<const Rgb8> picture, Image<float>& disparity,
                       const Progress& progress) {
  for (std::size_t i = 0; i < touches.size();) {
    const Touch& touch = touches[i];
    const std::span<const Touch> hand =
        touches.subspan(i, is_lasso(touch.kind) ? touches_of_hand(touches.subspan(i)) : 1);
    i += hand.size();
    report(progress, "retouching", 0);
    switch (touch.kind) {
      case Retouch::shift:
        brush_over(touch, disparity, [&](float d, float share, int, int) { return d + share * touch.amount; });
        break;
      case Retouch::smooth:
        smooth(touch, disparity);
        break;
      case Retouch::set:
        brush_over(touch, disparity, [&](float d, float share, int, int) { return d + share * (touch.amount - d); });
        break;
      case Retouch::fill:
        fill(touch, picture, disparity);
        break;
      case Retouch::shift_area:
        change_area(hand, disparity, [&](float d) { return d + touch.amount; });
        break;
      case Retouch::set_area:
        change_area(hand, disparity, [&](float) { return touch.amount; });
        break;
      case Retouch::detail:
      case Retouch::paint:
      case Retouch::erase:
      case Retouch::recolour:
        break;
    }
  }
}

void retouch_detail(std::span<const Touch> touches, Image<std::uint8_t>& detail) {
  for (const Touch& touch : touches)
    if (touch.kind == Retouch::detail)
      brush_over(touch, detail, [&](std::uint8_t level, float share, int, int) {
        return static_cast<std::uint8_t>(
            std::lround(std::clamp(static_cast<float>(level) + share * touch.amount, 0.f, 255.f)));
      });
}

}  // namespace wheatstone
