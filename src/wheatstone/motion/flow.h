#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Where each pixel of a frame goes, in pixels: what is at (x, y) in this frame is at (x + flow.x, y + flow.y) in the
/// other. Both images have the frame's size; NaN is unknown.
struct Flow {
  Image<float> x, y;
};

/// A value between pixels, interpolated bilinearly. (x, y) is a place of the picture, pixel centres at halves; beyond
/// the outermost centres the border continues. Undefined for NaN; the picture must not be empty.
float sample(ImageView<const float> image, float x, float y);

/// The colour there, channels 0..255.
struct SampledColour {
  float r = 0, g = 0, b = 0;
};
SampledColour sample(ImageView<const Rgb8> image, float x, float y);

}  // namespace wheatstone
