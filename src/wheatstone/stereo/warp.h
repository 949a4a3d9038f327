#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Which view a disparity belongs to, and is warped from.
enum class Eye { left, right };

/// The disparity of one eye carried forward into the other eye's geometry; nearest wins. Surfaces that the warp
/// stretches stay whole: neighbours on a scan line whose disparities differ by at most a pixel are joined. Pixels that
/// nothing lands on are NaN. Unknown disparities are passed over.
Image<float> warp_disparity(ImageView<const float> disparity, Eye from);

/// The same into any view: `step` eye separations to the right of the one that the disparity belongs to. `nearest` is
/// of the disparity's size and keeps what is nearer; NaN is farther than anything.
void warp_disparity_over(ImageView<const float> disparity, float step, Image<float>& nearest);

/// A picture carried into the other eye, and 255 for the pixels that something landed on.
struct WarpedPicture {
  Image<Rgb8> picture;
  Image<std::uint8_t> covered;
};

/// Carries a picture forward along its disparity, under the same rules; colours are interpolated along the scan line.
WarpedPicture warp_picture(ImageView<const Rgb8> picture, ImageView<const float> disparity, Eye from);

/// The same into the view `step` eye separations to the right.
WarpedPicture warp_picture(ImageView<const Rgb8> picture, ImageView<const float> disparity, float step);

/// For every pixel of the view `step` eye separations to the right: the column of this view, counted in pixel centres
/// from 0, whose point is seen there, and its disparity; both NaN where nothing lands.
struct WarpedColumns {
  Image<float> column, disparity;
};
WarpedColumns warp_columns(ImageView<const float> disparity, float step);

/// A picture that is being put together from several views, and the disparity of what it shows; NaN where nothing is.
struct Composition {
  Image<Rgb8> picture;
  Image<float> nearest;
};

/// Carries a picture into the composition's view, `step` eye separations to the right, where nothing is yet or what is
/// there is farther by more than `tolerance_px`. All are of one size.
void warp_picture_over(ImageView<const Rgb8> picture, ImageView<const float> disparity, float step, float tolerance_px,
                       Composition& composition);

/// Puts a warped picture over another of its size, where it is covered.
void lay_over(const WarpedPicture& warped, Image<Rgb8>& picture);

}  // namespace wheatstone
