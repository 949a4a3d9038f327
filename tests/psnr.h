#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "wheatstone/measures/view_measures.h"

namespace wheatstone {

/// Over all channels, in dB; infinite where the pictures are equal, 0 where their sizes differ.
inline double psnr_db(ImageView<const Rgb8> a, ImageView<const Rgb8> b) {
  return same_size(a, b) ? measure_view(a, b).psnr_db : 0;
}

/// That of the view that differs most from its reference, 1000 at most.
inline double worst_psnr(const std::vector<Image<Rgb8>>& views, const std::vector<Image<Rgb8>>& reference) {
  double worst = 1000;
  for (std::size_t v = 0; v < views.size(); ++v) worst = std::min(worst, psnr_db(views[v], reference[v]));
  return worst;
}

}  // namespace wheatstone
