#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Streaks of a disparity map reduced to 640 columns: the share of pixels that differ from the median of the 15 in
/// their column by more than 3 % of the map's range (2nd to 98th percentile), and from that of the 15 in their row by
/// less. Every disparity is known.
double streak_share(ImageView<const float> disparity);

/// Patches of a disparity map reduced to 800 columns: the share of pixels that differ from the median of the 41×41
/// pixels about them by more than 8 % of the map's range (2nd to 98th percentile), where the photograph has no edge
/// within 6 pixels. `picture` is of the map's size, every disparity is known.
double patch_share(ImageView<const float> disparity, ImageView<const Rgb8> picture);

}  // namespace wheatstone
