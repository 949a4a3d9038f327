#include "wheatstone/stereo/occlusion.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {

Image<std::uint8_t> dilate_occlusion(ImageView<const std::uint8_t> occlusion, int radius_px) {
  Image<std::uint8_t> dilated(occlusion.width(), occlusion.height());
  cv::Mat target = as_mat(dilated);
  cv::dilate(as_mat(occlusion), target,
             cv::getStructuringElement(cv::MORPH_RECT, {2 * radius_px + 1, 2 * radius_px + 1}));
  return dilated;
}

void remove_occlusion_specks(Image<std::uint8_t>& occlusion, int least_px) {
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(as_mat(occlusion), labels, statistics, centroids, 8);
  std::vector<std::uint8_t> kept(count);
  for (int label = 1; label < count; ++label)
    kept[label] = statistics.at<int>(label, cv::CC_STAT_AREA) >= least_px ? 255 : 0;
  for (int y = 0; y < occlusion.height(); ++y)
    for (int x = 0; x < occlusion.width(); ++x) occlusion(x, y) = kept[labels.at<int>(y, x)];
}

}  // namespace wheatstone
