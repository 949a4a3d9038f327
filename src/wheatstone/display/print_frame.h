#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/image/image.h"

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

}  // namespace wheatstone
