#pragma once

#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// The size of a picture whose longer side is brought to `longest_px` where it is longer; each side at least one pixel.
PictureSize reduced_size(PictureSize whole, int longest_px);

/// A smaller copy, each pixel the mean of the area that it covers. Sizes are at least 1x1.
Image<Rgb8> reduced(ImageView<const Rgb8> picture, PictureSize size);

/// Whether a picture has more than 8 million pixels. Memory then counts for more than time.
bool is_large(PictureSize size);

/// Whether two pictures' sizes differ by a few rows or columns, a fiftieth of a side at most, as crops of one size that
/// were made by hand do; false for one size.
bool differ_by_few(PictureSize a, PictureSize b);

/// Cuts two pictures whose sizes differ by a few rows or columns to their common size. It keeps the rows that fit best
/// by their mean brightness, and the columns in the middle, because columns are shifted in any pair.
void frame_common_part(StereoPair& pair);

}  // namespace wheatstone
