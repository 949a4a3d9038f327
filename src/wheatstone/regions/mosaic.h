#pragma once

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/motion/film_frame.h"

namespace wheatstone {

/// A tile of a mosaic in time.
struct MosaicTile {
  float x = 0, y = 0;                  ///< its centre, in its view
  float along_x = 1, along_y = 0;      ///< a unit vector along two of its sides
  float red = 0, green = 0, blue = 0;  ///< 0..255
  std::uint32_t view = 0;              ///< the number of its view in the scene
  friend bool operator==(const MosaicTile&, const MosaicTile&) = default;
};

/// What a film's mosaic remembers from one frame to the next; empty before the first.
struct MosaicMemory {
  std::vector<MosaicTile> tiles;
};

/// Where a film's tiles lie.
enum class TilePlaces {
  follow,  ///< they go with what they lie on where it moves faster than they could drift unseen, else they stay
  keep     ///< they stay, and the picture moves behind them (Bukenberger et al. 2015, sec. 4.2)
};

/// A frame of a film as a mosaic of stained glass (Hausner 2001; Bukenberger et al. 2015, sec. 4.2): tiles about
/// `style.tile_px` wide, a centroidal Voronoi diagram under the square metric turned along the picture's edges, which
/// tiles keep clear of. A tile shows the mean colour of what it covers, lies on one surface and is bordered by a darker
/// joint. All views show the tiles of the reference view; what only another one sees is tiled there.
///
/// In the frames that follow tiles begin where they lay a frame before, move only slightly, take their colours anew and
/// turn with the picture, both eased where the picture did not change at once. A tile that nothing is left of is
/// dropped, a gap gets new ones; tiles of other views than the reference keep their places. Throws Error: bad_input
/// where the views do not fit together, or the flow has not their size; wrong_usage for a style that cannot be painted
/// with.
RegionPainting plan_mosaic(const FilmFrame& frame, const Style& style, MosaicMemory& memory,
                           TilePlaces places = TilePlaces::follow);

}  // namespace wheatstone
