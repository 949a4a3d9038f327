#include "wheatstone/motion/expected_disparity.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {

template <class Pixel>
Image<Pixel> brought_along(const Image<Pixel>& before, const Flow& to_before, int width, int height, Pixel unknown) {
  Image<Pixel> result(width, height, unknown);
  // From pixels of the result, and of the flow, to those of the frame before.
  const float across = static_cast<float>(before.width()) / static_cast<float>(width),
              down = static_cast<float>(before.height()) / static_cast<float>(height);
  const float flow_across = static_cast<float>(before.width()) / static_cast<float>(to_before.x.width()),
              flow_down = static_cast<float>(before.height()) / static_cast<float>(to_before.x.height());
  Flow flow{Image<float>(width, height), Image<float>(width, height)};
  cv::Mat flow_x = as_mat(flow.x), flow_y = as_mat(flow.y);
  cv::resize(as_mat(to_before.x), flow_x, flow_x.size(), 0, 0, cv::INTER_LINEAR);
  cv::resize(as_mat(to_before.y), flow_y, flow_y.size(), 0, 0, cv::INTER_LINEAR);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float column = std::floor((static_cast<float>(x) + 0.5f) * across + flow.x(x, y) * flow_across);
      const float row = std::floor((static_cast<float>(y) + 0.5f) * down + flow.y(x, y) * flow_down);
      if (column >= 0 && row >= 0 && column < static_cast<float>(before.width()) &&
          row < static_cast<float>(before.height()))
        result(x, y) = before(static_cast<int>(column), static_cast<int>(row));
    }
  });
  return result;
}

template Image<std::uint8_t> brought_along(const Image<std::uint8_t>&, const Flow&, int, int, std::uint8_t);

Image<float> expected_disparity(const Image<float>& before, const Flow& to_before, int width, int height) {
  return brought_along(before, to_before, width, height, std::numeric_limits<float>::quiet_NaN());
}

Image<std::uint8_t> still_places(const Flow& to_before, int frame_width, int width, int height) {
  constexpr double still_px = 0.5;
  const double longest = still_px * to_before.x.width() / frame_width;
  cv::Mat length;
  cv::magnitude(as_mat(to_before.x), as_mat(to_before.y), length);
  Image<std::uint8_t> places(width, height);
  cv::Mat target = as_mat(places);
  cv::resize(length < longest, target, target.size(), 0, 0, cv::INTER_NEAREST);
  return places;
}

}  // namespace wheatstone
