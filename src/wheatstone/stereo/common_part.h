#pragma once

#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

/// Whether two pictures' sizes differ by a few rows or columns, a fiftieth of a side at most, as crops of one size that
/// were made by hand do; false for one size.
bool differ_by_few(ImageSize a, ImageSize b);

/// Cuts two pictures whose sizes differ by a few rows or columns to their common size: of rows, those which fit best,
/// by the rows' mean brightness; of columns, those in the middle, as the places of columns differ in any pair.
void frame_common_part(StereoPair& pair);

}  // namespace wheatstone
