#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// The tag Orientation of EXIF data, which begin with a TIFF header; 1, upright, where it is missing or damaged.
/// EXIF 2.3, sec. 4.5 and 4.6.4.
int exif_orientation(std::string_view exif);

/// EXIF 2.3, tag Orientation: 1 to 4 turn and mirror, 5 to 8 also swap rows and columns; anything else leaves the
/// picture as it is. Our own, because ImageBufAlgo::reorient confuses 5 and 7 (OpenImageIO 2.4.7).
template <class Pixel>
Image<Pixel> upright(Image<Pixel> stored, int orientation) {
  if (orientation <= 1 || orientation > 8) return stored;
  const bool swapped = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image<Pixel> shown(swapped ? stored.height() : stored.width(), swapped ? stored.width() : stored.height());
  for (int y = 0; y < shown.height(); ++y) {
    const std::span<Pixel> row = shown.row(y);
    for (int x = 0; x < shown.width(); ++x) {
      const int column = swapped ? y : x;
      const int line = swapped ? x : y;
      row[x] =
          stored(from_right ? stored.width() - 1 - column : column, from_below ? stored.height() - 1 - line : line);
    }
  }
  return shown;
}

}  // namespace wheatstone
