#include "wheatstone/stereo/reduced_pair.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {

PictureSize reduced_size(PictureSize whole, int longest_px) {
  const int longer = std::max(whole.width, whole.height);
  if (longer <= longest_px) return whole;
  const double scale = static_cast<double>(longest_px) / longer;
  const auto side = [&](int pixels) { return std::max(static_cast<int>(std::lround(pixels * scale)), 1); };
  return {side(whole.width), side(whole.height)};
}

Image<Rgb8> reduced(ImageView<const Rgb8> picture, PictureSize size) {
  Image<Rgb8> small(size.width, size.height);
  cv::Mat target = as_mat(small);
  cv::resize(as_mat(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace wheatstone
