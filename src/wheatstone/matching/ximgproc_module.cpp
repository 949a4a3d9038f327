#include <opencv2/ximgproc/disparity_filter.hpp>

#include "wheatstone/matching/refine_wls_internal.h"

extern "C" void wheatstone_refine_wls(const wheatstone::WlsInputs& inputs, cv::Mat& refined) {
  const auto filter = cv::ximgproc::createDisparityWLSFilterGeneric(true);
  filter->setLambda(inputs.lambda);
  filter->setSigmaColor(inputs.sigma);
  filter->setLRCthresh(inputs.check_tolerance);
  filter->setDepthDiscontinuityRadius(inputs.radius_px);
  filter->filter(inputs.left_disparity, inputs.left_picture, refined, inputs.right_disparity);
}
