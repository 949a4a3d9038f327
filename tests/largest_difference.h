#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Of any channel of any pixel; 256 where the sizes differ.
inline int largest_difference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  if (!same_size(a, b)) return 256;
  int most = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    most = std::max({most, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
  }
  return most;
}

}  // namespace wheatstone
