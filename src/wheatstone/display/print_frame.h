#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A part of a picture in pixels. Without a place it is the middle.
struct CropArea {
  int width = 0, height = 0;
  std::optional<int> left, top;
};

/// The largest part of this shape, in the middle.
struct CropShape {
  double width = 1, height = 1;
};
using Crop = std::variant<CropArea, CropShape>;

/// Reads "WIDTHxHEIGHT+X+Y", as ImageMagick's geometry, "WIDTHxHEIGHT" or a shape as "4:3". Throws Error{wrong_usage}
/// that begins with `option`.
Crop parse_crop(std::string_view words, std::string_view option);

/// The part of a picture. Throws Error{wrong_usage}, "--crop: ...", where it does not lie in the picture.
Image<Rgb8> cropped(ImageView<const Rgb8> picture, const Crop& crop);

/// A strip of one colour around a picture.
struct Border {
  float width = 0;  ///< in pixels, or as a share of the picture's longer side where `is_share`
  bool is_share = false;
  Rgb8 colour{255, 255, 255};
};

/// What is put around the views of a print or a show: the same around each, so that it lies on the screen.
struct PrintFrame {
  std::optional<Crop> crop;      ///< before anything else
  std::optional<Border> border;  ///< none: only a caption's strip, which is white
  std::string caption;           ///< UTF-8, below the picture; empty: none
};

/// Whether it changes anything.
bool has_print_frame(const PrintFrame& frame);

/// A picture with its border, and its caption in the lower part of it, which grows where the caption needs that. A
/// letter's height is a 28th of the picture's, at least 12 pixels. Throws as set_text.
Image<Rgb8> with_border_and_caption(ImageView<const Rgb8> picture, const PrintFrame& frame);

/// Widths of black strips, as put_floating_window takes them.
struct FloatingWindow {
  int left_px = 0;   ///< at the left edge of the left eye's picture
  int right_px = 0;  ///< at the right edge of the right eye's picture
  friend bool operator==(const FloatingWindow&, const FloatingWindow&) = default;
};

/// The narrowest strips with which the frame cuts nothing before the screen for one eye only. Disparity 0 is the
/// screen: what lies before it (disparity above 0) at the left edge of the right eye's picture lies further to the
/// right in the left eye's, which therefore shows more of it; the left strip covers what the right eye does not see of
/// it. The right strip does the same of the right eye's picture. `specks` is the share of the rows, at either side,
/// that may need more.
FloatingWindow floating_window_for(const StereoGeometryView& geometry, double specks = 0.01);

}  // namespace wheatstone
