#pragma once

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// The disparity of the view at `from` carried forward into the geometry of the view at `to`; nearest wins. Surfaces
/// that the warp stretches stay whole: neighbours on a scan line whose disparities differ by at most a pixel are
/// joined. Pixels that nothing lands on are NaN. Unknown disparities are passed over.
Image<float> warp_disparity(ImageView<const float> disparity, ViewPosition from, ViewPosition to);

/// The same over a disparity of the view at `to` that is there already, of the same size: what is nearer stays; NaN is
/// farther than anything.
void warp_disparity_over(ImageView<const float> disparity, ViewPosition from, ViewPosition to, Image<float>& nearest);

/// A picture carried into another view, and 255 for the pixels that something landed on.
struct WarpedPicture {
  Image<Rgb8> picture;
  Image<std::uint8_t> covered;
};

/// Carries the picture of the view at `from` forward along its disparity, under the same rules; colours are
/// interpolated along the scan line. Picture and disparity are of one size.
WarpedPicture warp_picture(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition from,
                           ViewPosition to);

/// For every pixel of the view at `to`: the column of the view at `from`, counted in pixel centres from 0, whose point
/// is seen there, and its disparity; both NaN where nothing lands.
struct WarpedColumns {
  Image<float> column, disparity;
};
WarpedColumns warp_columns(ImageView<const float> disparity, ViewPosition from, ViewPosition to);

/// A picture of the view at `position` that is being put together from several other views, and the disparity of what
/// it shows; NaN where nothing is.
struct Composition {
  ViewPosition position;
  Image<Rgb8> picture;
  Image<float> nearest;
  int left_px = 0;  ///< column of the view at which its picture begins
};

/// Carries the picture of the view at `from` into the composition's view, where that is empty or farther by more than
/// `tolerance_px`. All are of one height.
void warp_picture_over(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition from,
                       float tolerance_px, Composition& composition);

/// Puts a warped picture over another of its size, where it is covered.
void lay_over(const WarpedPicture& warped, Image<Rgb8>& picture);

}  // namespace wheatstone
