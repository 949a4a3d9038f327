#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "wheatstone/video/frame.h"

namespace wheatstone {

/// How a film's frame holds two eyes. The name says the order of the eyes: the first is on the left, on top, in the
/// even rows or columns (counted from 0), in the square of the first pixel, or in the first of two frames. `half`: the
/// eyes are squeezed to half their width or height.
enum class FilmLayout {
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

/// "left-right" and so on: the enumerator with hyphens.
const char* name_of(FilmLayout layout);

/// The layout of that name, of ffmpeg's alias ("sbsl", "ab2r", …) or of a short name ("sbs", "tb-half", …); nothing
/// where there is none.
std::optional<FilmLayout> film_layout_named(std::string_view name);

/// All names with ffmpeg's aliases, for help and error messages: "mono (ml), left-right (sbsl), …".
std::string film_layout_names();

/// Two eyes' pictures of one moment, same size; `right` is empty where the layout is mono. Times as in Frame.
struct StereoFrame {
  Image<Rgb8> left;
  Image<Rgb8> right;
  std::int64_t pts = 0;
  Rational time_base{1, 1};
  std::int64_t duration = 0;
};

/// The eyes of one packed picture, with square pixels: what the layout halved is interpolated back (linearly; pixels
/// that are there stay as they are in rows, columns and checkerboard). Throws Error{bad_input} where the size cannot be
/// halved, and Error{wrong_usage} for alternating, whose eyes lie in two frames (see StereoFilmReader).
StereoFrame split(const Image<Rgb8>& picture, FilmLayout layout);

/// The packed picture of two eyes of the same size; undoes `split` exactly where nothing was squeezed. Squeezing
/// averages two pixels. Mono gives the left eye. Throws Error{wrong_usage} for alternating, and where sizes differ or
/// are odd and would have to be halved.
Image<Rgb8> join(const Image<Rgb8>& left, const Image<Rgb8>& right, FilmLayout layout);

}  // namespace wheatstone
