#include "wheatstone/stereo/framed_pair_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

/// A part of a picture, scaled to whole pixels, and the middle of that.
struct Fitting {
  cv::Rect part;
  cv::Size scaled;
  cv::Rect middle;
};

template <class Pixel>
Image<Pixel> fitted(const Image<Pixel>& picture, const Fitting& fitting, int interpolation) {
  cv::Mat scaled;
  cv::resize(as_mat(picture)(fitting.part), scaled, fitting.scaled, 0, 0, interpolation);
  Image<Pixel> result(fitting.middle.width, fitting.middle.height);
  scaled(fitting.middle).copyTo(as_mat(result));
  return result;
}

Image<float> fitted_disparity(const Image<float>& disparity, const Fitting& fitting, int shift) {
  // Between two surfaces there is no third one: disparities are not interpolated.
  Image<float> result = fitted(disparity, fitting, cv::INTER_NEAREST);
  const double scale = static_cast<double>(fitting.scaled.width) / fitting.part.width;
  for (float& d : result.pixels()) d = static_cast<float>((static_cast<double>(d) - shift) * scale);
  return result;
}

}  // namespace

FramedPair framed(const StereoPair& photographs, const StereoGeometry& geometry, const ScreenFrame& frame) {
  const int width = photographs.left.width(), height = photographs.left.height();
  const int shift = static_cast<int>(std::lround(frame.zero_parallax_px));
  const int common = width - std::abs(shift);
  if (frame.width < 1 || frame.height < 1 || common < 1 || height < 1)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("a picture of {}x{} pixels, shifted by {}, cannot fill {}x{} pixels", width, height, shift,
                            frame.width, frame.height));
  const double scale = std::max(static_cast<double>(frame.width) / common, static_cast<double>(frame.height) / height);
  const cv::Size scaled(std::max(static_cast<int>(std::lround(common * scale)), frame.width),
                        std::max(static_cast<int>(std::lround(height * scale)), frame.height));
  FramedPair result;
  result.scale = static_cast<float>(scale);
  result.margin_px = std::clamp(frame.margin_px, 0, (scaled.width - frame.width) / 2);
  const int shown = frame.width + 2 * result.margin_px;
  const cv::Rect middle((scaled.width - shown) / 2, (scaled.height - frame.height) / 2, shown, frame.height);
  const Fitting left{{std::max(shift, 0), 0, common, height}, scaled, middle};
  const Fitting right{{std::max(-shift, 0), 0, common, height}, scaled, middle};
  const int interpolation = scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC;
  result.photographs = {fitted(photographs.left, left, interpolation), fitted(photographs.right, right, interpolation)};
  result.geometry = geometry_from_both(fitted_disparity(geometry.left_disparity, left, shift),
                                       fitted_disparity(geometry.right_disparity, right, shift));
  return result;
}

}  // namespace wheatstone
