#pragma once

#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/pictures/find_faces.h"

namespace wheatstone {

/// How much of a photograph its painting keeps, and how its paint looks. Likeness counts only together with the other
/// two: a photograph that is blurred a little is like itself, but has no grain, and with noise its grain has no
/// streaks.
struct PaintingLikeness {
  /// Mean similarity of gradient magnitudes, 0..1; 1: equal. Xue, Zhang, Mou & Bovik 2014, "Gradient magnitude
  /// similarity deviation", eq. 4, with c = 170 for luminance in 0..255 that is averaged over 2×2 pixels first.
  double gms = 0;
  double gms_detail = 0;  ///< the same, of the tenth of the pixels with the most detail for their brightness
  double lab = 0;         ///< mean distance in CIE L*a*b*, after both are blurred by 2 pixels
  double grain = 0;       ///< mean contrast of the painting below 2 pixels, in L*, where the photograph is plain
  double streaks = 0;     ///< how much of that contrast runs in one direction, 0..1: noise about 0.15, strokes more
};

/// Measures in pixels of the photograph: a painting of another size is resampled, by area. So draw it larger. Throws
/// Error{bad_input} where a picture is empty, or the painting has another shape than the photograph.
PaintingLikeness measure_likeness(ImageView<const Rgb8> photograph, ImageView<const Rgb8> painting);

/// Mean similarity of gradient magnitudes, as PaintingLikeness::gms, in each face of the photograph, both pictures cut
/// out and brought to a width of 160 pixels. Faces are boxes in the photograph. Throws as measure_likeness does.
std::vector<double> measure_faces(ImageView<const Rgb8> photograph, ImageView<const Rgb8> painting,
                                  const std::vector<PixelBox>& faces);

}  // namespace wheatstone
