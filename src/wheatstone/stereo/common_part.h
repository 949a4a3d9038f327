#pragma once

#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

/// Whether two pictures' sizes differ by a few rows or columns, a fiftieth of a side at most, as crops of one size that
/// were made by hand do; false for one size.
bool differ_by_few(ImageSize a, ImageSize b);

/// Cuts two pictures whose sizes differ by a few rows or columns to their common size. It keeps the rows that fit best
/// by their mean brightness, and the columns in the middle, because columns are shifted in any pair.
void frame_common_part(StereoPair& pair);

}  // namespace wheatstone
