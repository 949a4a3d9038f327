#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/pictures/faces_module_internal.h"

extern "C" bool wheatstone_find_faces(const std::string& cascade, wheatstone::ImageView<const wheatstone::Rgb8> picture,
                                      int searched_width_px, std::vector<wheatstone::PixelBox>& faces) {
  cv::CascadeClassifier classifier;
  if (!classifier.load(cascade)) return false;
  constexpr double step = 1.1;
  constexpr int least_neighbours = 6, least_side_px = 40;
  cv::Mat grey, searched;
  cv::cvtColor(wheatstone::as_mat(picture), grey, cv::COLOR_RGB2GRAY);
  const double scale = static_cast<double>(searched_width_px) / grey.cols;
  cv::resize(grey, searched, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  std::vector<cv::Rect> found;
  classifier.detectMultiScale(searched, found, step, least_neighbours, 0, {least_side_px, least_side_px});
  const auto in_picture = [scale](int px) { return static_cast<int>(px / scale); };
  for (const cv::Rect& face : found)
    faces.push_back({in_picture(face.x), in_picture(face.y), in_picture(face.width), in_picture(face.height)});
  // OpenCV's threads give them in any order.
  std::ranges::sort(faces, {}, [](const wheatstone::PixelBox& face) {
    return std::array{face.top, face.left, face.width, face.height};
  });
  return true;
}
