#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Which pixels of a two-view screen show the left view: those of its first row, column or corner.
enum class Interlacing {
  rows,          ///< even rows left, odd rows right, counted from the top
  columns,       ///< even columns left
  checkerboard,  ///< left where column and row are both even or both odd
};

/// What it is called here and by ffmpeg, with the left view first.
struct InterlacingName {
  Interlacing interlacing;
  std::string_view name;
  std::string_view ffmpeg;
};
std::span<const InterlacingName> interlacing_names();

/// By either name. Throws Error{wrong_usage} listing the names.
Interlacing find_interlacing(std::string_view name);

/// 0 where pixel (x, y) shows the left view, 1 where it shows the right one.
int view_of_pixel(Interlacing interlacing, int x, int y);

/// The picture for the screen: each pixel from the view that it shows, of which it has the other half left out. The
/// views have the screen's size: interlacing is done on the screen's own pixels, after any scaling. For a screen that
/// begins with the right view, swap the views. Throws Error{wrong_usage} where the sizes differ.
Image<Rgb8> interlaced(ImageView<const Rgb8> left, ImageView<const Rgb8> right, Interlacing interlacing);

}  // namespace wheatstone
