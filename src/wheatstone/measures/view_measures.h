#pragma once

#include <cstddef>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// How far one view is from the reference for it.
///
/// An isolated splat is a spot in the reference at whose peak a channel is 48 or more, while none is above 12 from 5 to
/// 9 pixels around. Its place is the centroid of its linear light above what surrounds it.
struct ViewMeasures {
  double psnr_db = 0;                    ///< over all channels, peak 255; infinite where the two are equal
  double differing_share = 0;            ///< pixels of which any channel differs
  std::size_t differing_pixels = 0;      ///< by more than `noticeable` (Hassaine 2010, table 5.4 counts such pixels)
  std::size_t isolated_splats = 0;       ///< spots that stand alone in the reference
  double largest_position_error_px = 0;  ///< of their centroids, of those that are found again; 0 where there are none
  std::size_t lost_splats = 0;           ///< isolated ones of which not a quarter of the light is within 3 pixels
};

struct ViewMeasuresOptions {
  int noticeable = 4;  ///< a difference of channel values, 0..255, that counts
};

/// Both pictures are of the same size, and not empty.
ViewMeasures measure_view(ImageView<const Rgb8> view, ImageView<const Rgb8> reference,
                          const ViewMeasuresOptions& options = {});

}  // namespace wheatstone
