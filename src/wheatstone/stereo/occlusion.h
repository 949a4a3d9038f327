#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Grows a mask by a square of 2r + 1 pixels: one dilation a pixel of radius (Stavrakis & Gelautz 2004, sec. 3.2).
Image<std::uint8_t> dilate_occlusion(ImageView<const std::uint8_t> occlusion, int radius_px);

/// Takes specks of fewer than `least_px` connected pixels off a mask: they come from noise in the disparity and would
/// only split strokes.
void remove_occlusion_specks(Image<std::uint8_t>& occlusion, int least_px);

}  // namespace wheatstone
