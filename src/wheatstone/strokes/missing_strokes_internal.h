#pragma once

#include <cstdint>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A layer whose carried strokes are painted. All have the view's size.
struct CarriedGround {
  const Image<float>& before;            ///< squared RGB error that the coarser layers left; negative: not wanted
  const Image<float>& after;             ///< the same with the carried strokes
  const Image<std::uint8_t>& begun;      ///< 255 within half a cell of where one of them begins
  ImageView<const std::uint8_t> beside;  ///< 255 beside depth edges, where cells are half as wide; may be empty
  float cell_px = 4;                     ///< of the grid in which strokes begin
  float threshold = 100;                 ///< T
};

/// 255 where strokes may begin. Painting anew would begin one at the worst pixel of each cell of the grid. A cell is
/// left alone where a carried stroke begins there, or paints that pixel rightly; so nothing begins in a picture that
/// stands still, and a thing that is new in the picture is painted although other strokes lie in its cell.
Image<std::uint8_t> missing_strokes(const CarriedGround& ground);

}  // namespace wheatstone
