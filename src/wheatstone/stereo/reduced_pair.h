#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

struct PictureSize {
  int width = 0, height = 0;
};

/// The size of a picture whose longer side is brought to `longest_px` where it is longer; each side at least one pixel.
PictureSize reduced_size(PictureSize whole, int longest_px);

/// A smaller copy, each pixel the mean of the area that it covers. Sizes are at least 1x1.
Image<Rgb8> reduced(ImageView<const Rgb8> picture, PictureSize size);

}  // namespace wheatstone
