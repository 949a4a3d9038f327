#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Where the two eyes' pictures lie in one. The half ones are squeezed to half their width or height.
enum class StereoLayout {
  left_right,       ///< the left eye's picture on the left: for parallel viewing
  left_right_half,  ///< the same, each squeezed to half its width
  right_left,       ///< the right eye's picture on the left: for cross-eyed viewing
  right_left_half,
  top_bottom,  ///< the left eye's picture above
  top_bottom_half,
  bottom_top,  ///< the right eye's picture above
  bottom_top_half,
};

/// Our own name of a layout, as "left-right-half".
std::string_view layout_name(StereoLayout layout);

/// A layout in words, as "side by side, left eye left, half width".
std::string_view layout_words(StereoLayout layout);

/// The names of all layouts, in the order of the enumeration.
std::span<const std::string_view> layout_names();

/// The layout of this name or alias: ffmpeg's (sbsl, abr), the players' (sbs, tb, hou), "cross-eyed", "parallel".
/// Throws Error{wrong_usage} that lists the names, and for an anaglyph says why it cannot be taken apart.
StereoLayout layout_by_name(std::string_view name);

/// The same layout with the eyes changed over.
StereoLayout with_eyes_swapped(StereoLayout layout);

/// The same layout, squeezed or not.
StereoLayout with_half_size(StereoLayout layout, bool half);

bool is_half_size(StereoLayout layout);
bool is_side_by_side(StereoLayout layout);  ///< false: one above the other
bool is_left_first(StereoLayout layout);    ///< the left eye's picture is the left or the upper one

/// Takes a picture of this layout apart; halves are brought back to full size (Lanczos). Throws Error{bad_input} that
/// names the picture as `name` where it cannot be halved evenly.
StereoPair cut_apart(ImageView<const Rgb8> picture, StereoLayout layout, const std::string& name);

/// Both pictures, of one size, in one: what cut_apart takes apart. Squeezing averages the pixels that become one.
Image<Rgb8> put_together(ImageView<const Rgb8> left, ImageView<const Rgb8> right, StereoLayout layout);

}  // namespace wheatstone
