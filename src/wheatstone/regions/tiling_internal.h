#pragma once

#include <span>
#include <vector>

#include "wheatstone/regions/mosaic.h"
#include "wheatstone/regions/plan_regions_internal.h"

namespace wheatstone {

/// A view cut into tiles.
struct Tiles {
  RegionMap regions;  ///< connected, each on one surface
  std::vector<MosaicTile> laid;
  std::vector<std::int32_t> before;   ///< of each tile laid: which one it was a frame before, −1: none
  std::vector<std::int32_t> tile_of;  ///< of each region: the tile laid whose main part it is, −1: of none
};

/// Lays the tiles of one view anew, after its picture without grain.
Tiles lay_tiles(const ViewToCut& view, ImageView<const Rgb8> picture, float tile_px);

/// Lays them where they lay a frame before: they turn with the picture, take its colours and move only slightly.
/// Tiles of which nothing is left are dropped, and gaps get new ones.
Tiles lay_tiles_again(const ViewToCut& view, ImageView<const Rgb8> picture, float tile_px,
                      std::span<const MosaicTile> before);

}  // namespace wheatstone
