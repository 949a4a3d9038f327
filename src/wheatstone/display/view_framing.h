#pragma once

#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// How a picture is shown in a frame of another shape. By default it fills the frame, and is cut off at two sides.
struct ViewFraming {
  bool whole = false;       ///< all of it is shown, with bars at two sides; nothing else counts
  double x = 0.5, y = 0.5;  ///< the place, 0..1 from the picture's upper left corner, that comes to the frame's middle
  double zoom = 1;          ///< times as large as where it fills the frame; below 1 it may leave bars
  friend bool operator==(const ViewFraming&, const ViewFraming&) = default;
};

/// Reads "fit", "fill" or "X,Y,ZOOM". Throws Error{wrong_usage} that begins with `option`.
ViewFraming parse_view_framing(std::string_view words, std::string_view option);

/// The part of a picture that a frame shows: a place (x, y) of the picture lies at ((x − left) · scale · stretch,
/// (y − top) · scale) in the frame. A frame that fills moves no further than to the picture's edge.
struct ShownPart {
  double left = 0, top = 0, scale = 1;
  double stretch = 1;  ///< of a frame whose pixels are not square: its screen shows them 1 / stretch times as wide
};
ShownPart shown_part(double picture_width, double picture_height, double frame_width, double frame_height,
                     const ViewFraming& framing, double stretch = 1);

/// The pixels of the frame that the picture covers: columns left to right, rows top to bottom, ends not included.
struct CoveredPart {
  int left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const CoveredPart&, const CoveredPart&) = default;
};
CoveredPart covered_part(double picture_width, double picture_height, int frame_width, int frame_height,
                         const ShownPart& part);

/// Makes everything of a frame but the covered part black.
void put_bars(const CoveredPart& covered, ImageView<Rgb8> frame);

/// A picture in a frame of this size, black where it does not reach.
Image<Rgb8> framed_view(ImageView<const Rgb8> picture, int frame_width, int frame_height, const ViewFraming& framing);

/// The same of a part that is known, in parts of a pixel.
Image<Rgb8> framed_view(ImageView<const Rgb8> picture, int frame_width, int frame_height, const ShownPart& part);

}  // namespace wheatstone
