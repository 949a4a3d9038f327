#include <opencv2/dnn.hpp>

#include "wheatstone/matching/network_picture_internal.h"

namespace wheatstone {

cv::Mat network_picture(const cv::Mat& picture, NetworkValues values) {
  cv::Mat numbers;
  picture.convertTo(numbers, CV_32FC3, values == NetworkValues::to_255 ? 1 : 1 / 255.0);
  if (values == NetworkValues::imagenet) {
    cv::subtract(numbers, cv::Scalar(0.485, 0.456, 0.406), numbers);
    cv::divide(numbers, cv::Scalar(0.229, 0.224, 0.225), numbers);
  }
  return cv::dnn::blobFromImage(numbers);
}

}  // namespace wheatstone
