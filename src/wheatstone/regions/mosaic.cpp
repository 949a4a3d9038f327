#include "wheatstone/regions/mosaic.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "wheatstone/image/grain.h"
#include "wheatstone/image/orientation_field.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/regions/outline_internal.h"
#include "wheatstone/regions/tiling_internal.h"

namespace wheatstone {
namespace {

/// The joint's brightness, as a multiple of the tile's, and half its width, for a picture 640 pixels wide.
constexpr double joint_light = 0.45;
constexpr float half_joint_px = 0.55f;

Rgb8 colour_of(const RegionMeans& means, double light) {
  const auto level = [&](double value) { return static_cast<std::uint8_t>(std::lround(light * value)); };
  return {level(means.red), level(means.green), level(means.blue)};
}

/// Where a corner between two sides of a ring comes to lie when both move inwards: along the bisector, and no
/// farther than twice as far.
ControlPoint moved_inwards(const ControlPoint& before, const ControlPoint& at, const ControlPoint& after, float inset) {
  const auto normal = [](const ControlPoint& from, const ControlPoint& to) {
    const float dx = to.x - from.x, dy = to.y - from.y, length = std::max(std::hypot(dx, dy), 1e-6f);
    return Direction{dy / length, -dx / length};
  };
  const Direction a = normal(before, at), b = normal(at, after);
  const float x = a.x + b.x, y = a.y + b.y;
  const float squared = std::max(x * x + y * y, 1.f);
  return {at.x + 2 * inset * x / squared, at.y + 2 * inset * y / squared, at.disparity};
}

/// The glass of a tile: its ring without the joint. Rings have their region to the left, y down.
void add_face(const RegionMark& joint, Rgb8 colour, float inset, RegionPainting& painting) {
  RegionMark face = joint;
  face.colour = colour;
  face.first_ring = static_cast<std::uint32_t>(painting.rings.size());
  for (std::uint32_t r = 0; r < joint.ring_count; ++r) {
    const Ring ring = painting.rings[joint.first_ring + r];
    const auto first = static_cast<std::uint32_t>(painting.points.size());
    for (std::uint32_t i = 0; i < ring.point_count; ++i) {
      const auto point = [&](std::uint32_t k) { return painting.points[ring.first_point + k % ring.point_count]; };
      painting.points.push_back(moved_inwards(point(i + ring.point_count - 1), point(i), point(i + 1), inset));
    }
    painting.rings.push_back({first, ring.point_count});
  }
  painting.marks.push_back(face);
}

/// Adds the joints and the faces of a view's tiles, each of its mean colour.
void add_tiles(const ViewToCut& view, const Tiles& tiles, std::span<const RegionMeans> means,
               RegionPainting& painting) {
  const std::size_t first = painting.marks.size();
  add_outlines(tiles.regions, view.disparity, view.position,
               {.tolerance_px = 0.9f, .depth_threshold_px = view.depth_threshold_px}, painting);
  for (std::size_t i = 0; i < means.size(); ++i) {
    RegionMark& joint = painting.marks[first + i];
    joint.colour = colour_of(means[i], joint_light);
    joint.disparity = static_cast<float>(means[i].disparity);
    joint.views = view.views;
  }
  // All faces after all joints: at drawing, marks of one depth keep their order.
  for (std::size_t i = 0; i < means.size(); ++i)
    add_face(RegionMark(painting.marks[first + i]), colour_of(means[i], 1), half_joint_px * view.scale, painting);
}

/// A tile's colour goes a share of the way to the picture's, all of it where they differ by more in a channel.
constexpr double colour_share = 0.4, new_thing = 32;

void ease(const MosaicTile& before, RegionMeans& means) {
  const double red = means.red - static_cast<double>(before.red),
               green = means.green - static_cast<double>(before.green),
               blue = means.blue - static_cast<double>(before.blue);
  if (std::max({std::abs(red), std::abs(green), std::abs(blue)}) > new_thing) return;
  means.red -= (1 - colour_share) * red;
  means.green -= (1 - colour_share) * green;
  means.blue -= (1 - colour_share) * blue;
}

/// Lays a view's tiles where `before` has them, and puts them into what the next frame remembers.
void cut_tiles_again(const ViewToCut& view, const Style& style, std::span<const MosaicTile> before,
                     std::vector<MosaicTile>& after, RegionPainting& painting) {
  const float tile_px = style.tile_px * view.scale;
  const Image<Rgb8> picture =
      view.number == 0 ? without_grain(view.colour, view.scale) : without_grain_quickly(view.colour);
  const Tiles tiles =
      before.empty() ? lay_tiles(view, picture, tile_px) : lay_tiles_again(view, picture, tile_px, before);
  std::vector<RegionMeans> means = means_of(tiles.regions, view.colour, view.disparity);
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (tiles.tile_of[i] < 0) continue;
    const auto index = static_cast<std::size_t>(tiles.tile_of[i]);
    MosaicTile tile = tiles.laid[index];
    if (tiles.before[index] >= 0) ease(before[static_cast<std::size_t>(tiles.before[index])], means[i]);
    tile.red = static_cast<float>(means[i].red);
    tile.green = static_cast<float>(means[i].green);
    tile.blue = static_cast<float>(means[i].blue);
    after.push_back(tile);
  }
  add_tiles(view, tiles, means, painting);
}

/// Moves the reference view's tiles along the flow, but for those whose ground moves less than this a frame: going with
/// it by parts of a pixel would make their joints tremble.
constexpr float still_px = 0.4f;

void carry(std::vector<MosaicTile>& tiles, const Flow& forward) {
  for (MosaicTile& tile : tiles) {
    if (tile.view != 0) break;
    const float x = sample(forward.x.view(), tile.x, tile.y), y = sample(forward.y.view(), tile.x, tile.y);
    if (!(std::hypot(x, y) >= still_px)) continue;
    tile.x += x;
    tile.y += y;
  }
}

}  // namespace

RegionPainting plan_mosaic(const FilmFrame& frame, const Style& style, MosaicMemory& memory, TilePlaces places) {
  std::vector<MosaicTile> before, after;
  if (frame.flow != nullptr) {
    check_fits(*frame.flow, frame.views);
    before = memory.tiles;
    if (places == TilePlaces::follow) carry(before, frame.flow->forward);
  }
  RegionPainting painting =
      plan_regions(frame.views, style, [&](const ViewToCut& view, const Style&, RegionPainting& to) {
        std::vector<MosaicTile> own;
        std::ranges::copy_if(before, std::back_inserter(own),
                             [&](const MosaicTile& tile) { return tile.view == view.number; });
        cut_tiles_again(view, style, own, after, to);
      });
  memory.tiles = std::move(after);
  return painting;
}

}  // namespace wheatstone
