#pragma once

// The one table of layouts: names, aliases, and how containers number them.

#include <span>

#include "wheatstone/video/film_layout.h"

namespace wheatstone {

enum class Arrangement { whole, side_by_side, over_under, rows, columns, checkerboard, in_time };

struct LayoutTraits {
  FilmLayout layout;
  const char* name;
  const char* ffmpeg;  ///< of its stereo3d filter
  Arrangement arrangement;
  bool right_first;
  bool half;
  const char* matroska;  ///< StereoMode as libavformat spells it
};

std::span<const LayoutTraits> all_layouts();
const LayoutTraits& traits_of(FilmLayout layout);
FilmLayout layout_with(Arrangement arrangement, bool right_first, bool half);

}  // namespace wheatstone
