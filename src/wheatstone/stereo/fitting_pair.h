#pragma once

#include <string_view>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Throws Error{bad_input}, "NAME is WxH pixels, expected OWNER WxH", where the two sizes differ.
void check_sizes(std::string_view name, PictureSize found, std::string_view owner, PictureSize expected);

/// The same of images and masks of any kind.
template <class A, class B>
void check_same_size(std::string_view name, const A& image, std::string_view owner, const B& expected) {
  check_sizes(name, {image.width(), image.height()}, owner, {expected.width(), expected.height()});
}

/// Throws Error{bad_input} unless two pictures are of one size.
void check_fits(const StereoPairView& pair);

/// Throws Error{bad_input} unless photographs and geometry are of one size, not empty, and every disparity is known. Of
/// one view, the right picture is empty, and of its geometry only the left disparity counts.
void check_fits(const StereoPairView& photographs, const StereoGeometryView& geometry);

/// Throws Error{bad_input} where a disparity is unknown.
void check_has_no_unknowns(ImageView<const float> disparity);

}  // namespace wheatstone
