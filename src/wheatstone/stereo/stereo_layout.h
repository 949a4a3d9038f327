#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace wheatstone {

/// How one picture, or a film's frame, holds two eyes. The name says the order of the eyes: the first is on the left,
/// on top, in the even rows or columns (counted from 0), in the square of the first pixel, or in the first of two
/// frames. `half`: the eyes are squeezed to half their width or height.
enum class StereoLayout {
  mono,  ///< one eye
  left_right,
  left_right_half,
  right_left,  ///< cross-eyed
  right_left_half,
  top_bottom,  ///< left eye on top
  top_bottom_half,
  bottom_top,  ///< right eye on top
  bottom_top_half,
  even_odd_rows,  ///< left eye in the even rows
  odd_even_rows,
  even_odd_columns,
  odd_even_columns,
  checkerboard,  ///< left eye at (0, 0)
  checkerboard_right_first,
  alternating,  ///< left eye first
  alternating_right_first,
};

/// Where the eyes lie, whichever is first.
enum class Arrangement { whole, side_by_side, over_under, rows, columns, checkerboard, in_time };

/// One line of the table of layouts, from which names, aliases, help, packing and metadata are made.
struct LayoutTraits {
  StereoLayout layout;
  std::string_view name;  ///< the enumerator with hyphens
  Arrangement arrangement;
  bool right_first;
  bool half;                  ///< half of each eye's pixels are there
  std::string_view ffmpeg;    ///< of its stereo3d filter
  std::string_view matroska;  ///< StereoMode as libavformat spells it
  std::string_view words;     ///< "side by side, left eye left, half width"
  /// What players, editors and cameras call it, without hyphens, a space between two. In file names, too.
  std::string_view aliases;
  std::string_view full_aliases;  ///< those that also say that the eyes are not squeezed
};

/// The table, in the order of the enumeration.
std::span<const LayoutTraits> stereo_layouts();
const LayoutTraits& traits_of(StereoLayout layout);

/// The layout with these properties. `half` counts only for side by side and one above the other.
StereoLayout layout_with(Arrangement arrangement, bool right_first, bool half);

/// Our own name of a layout, as "left-right-half".
std::string_view layout_name(StereoLayout layout);

/// The layout of this name or alias: ours ("left-right"), ffmpeg's ("sbsl", "ab2r"), the players' ("sbs", "hou",
/// "cross-eyed", "tb-half"); hyphens in aliases do not count. Nothing where there is none.
std::optional<StereoLayout> find_stereo_layout(std::string_view name);

/// All names with ffmpeg's, for help and error messages: "mono (ml), left-right (sbsl), …".
std::string stereo_layout_names();

/// The names of the layouts that hold both eyes in one picture (is_packed).
std::span<const std::string_view> layout_names();

/// Whether the word is one of those in `aliases`, which have a space between two.
bool is_among(std::string_view aliases, std::string_view word);

/// Both eyes lie in one picture.
bool is_packed(StereoLayout layout);

/// The same layout with the eyes changed over; mono stays.
StereoLayout with_eyes_swapped(StereoLayout layout);

/// The same layout, squeezed or not; only side by side and one above the other come in two sizes.
StereoLayout with_half_size(StereoLayout layout, bool half);

bool is_half_size(StereoLayout layout);
bool is_side_by_side(StereoLayout layout);
bool is_left_first(StereoLayout layout);

}  // namespace wheatstone
