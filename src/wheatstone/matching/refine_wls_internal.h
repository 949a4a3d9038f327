#pragma once

#include <opencv2/core.hpp>

namespace wheatstone {

/// What OpenCV's weighted least squares (ximgproc) work on: disparities of both views in sixteenths of a pixel.
struct WlsInputs {
  cv::Mat left_disparity, right_disparity, left_picture;
  double lambda = 0, sigma = 0;
  int check_tolerance = 0;  ///< in sixteenths, too
  int radius_px = 0;        ///< of depth's discontinuities
};

/// The refined disparity of the left view. It is of a module, because the libraries behind ximgproc take longer to load
/// than all others that matching needs.
using RefineWls = void(const WlsInputs& inputs, cv::Mat& refined);
inline constexpr auto wls_module_name = "wheatstone_ximgproc";
inline constexpr std::size_t wls_module_bytes = std::size_t{16} << 20;
inline constexpr auto refine_wls_name = "wheatstone_refine_wls";

}  // namespace wheatstone
