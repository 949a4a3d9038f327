#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// What is filled by: the left picture, 8-bit RGB, and where it is plain, 255.
struct PictureToFill {
  cv::Mat picture, plain;
};

/// Gives every unknown pixel of the left disparity a value: what the right view hides takes that of the farther surface
/// beside it, and all else that of its surroundings, spread over the picture but not across its edges (the fast global
/// smoother of Min et al. 2014, as a solver with confidences). Plain places
/// are taken for far: they are drawn to the farther of the surfaces around. `other` is the disparity of the right view,
/// by which hidden pixels are told. Throws Error{bad_input} where nothing is known.
void fill_in_picture(Image<float>& disparity, const Image<float>& other, const PictureToFill& by);

}  // namespace wheatstone
