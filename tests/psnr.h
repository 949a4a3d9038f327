#pragma once

#include "wheatstone/measures/view_measures.h"

namespace wheatstone {

/// Over all channels, in dB; infinite where the pictures are equal, 0 where their sizes differ.
inline double psnr_db(ImageView<const Rgb8> a, ImageView<const Rgb8> b) {
  return same_size(a, b) ? measure_view(a, b).psnr_db : 0;
}

}  // namespace wheatstone
