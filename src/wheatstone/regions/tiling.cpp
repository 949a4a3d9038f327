#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/image/orientation_field.h"
#include "wheatstone/marks/spline.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/random.h"
#include "wheatstone/regions/tiling_internal.h"

namespace wheatstone {
namespace {

struct Tile {
  float x = 0, y = 0;
  Direction along;
  std::int32_t surface = -1;
  float red = 0, green = 0, blue = 0;  ///< mean colour
  float area = 0;                      ///< in pixels, by its last cell
  std::int32_t before = -1;            ///< which tile it was a frame before
  bool elsewhere = false;              ///< lies on something else than then
};

/// How much a tile's shape gives way to the picture's colours: a difference of 255 in one channel is as far as this
/// many tiles' halves.
constexpr float colour_weight = 3;
constexpr int lloyd_rounds = 30;
/// A pixel asks the tiles of the 5 × 5 cells around its own.
constexpr int reach_cells = 2;

/// In time, the share of the way to its cell's middle that a tile goes, and of the turn to the picture's direction.
constexpr float move_share = 0.2f, turn_share = 0.25f;
/// A tile whose colour differs by more from its place's in a channel is taken to lie on something new.
constexpr float new_thing_levels = 40;
/// A tile with a smaller cell than this share of a whole one is gone, one that lies on something new sooner; a gap of
/// this share of one gets a new tile.
constexpr float gone_share = 0.05f, crowded_share = 0.4f, gap_share = 0.4f;
/// Pixels farther from their tile than this many of its halves lie in a gap.
constexpr float gap_halves = 1.7f;

/// The surfaces of the picture, each a connected region.
RegionMap find_surfaces(const ViewToCut& view) {
  Image<std::int32_t> labels(view.disparity.width(), view.disparity.height());
  if (!view.wanted.empty())
    for (int y = 0; y < labels.height(); ++y)
      for (int x = 0; x < labels.width(); ++x) labels(x, y) = view.wanted(x, y) != 0 ? 0 : -1;
  return connected_regions(labels, view.disparity, view.depth_threshold_px);
}

float between(float from, float to, float share) { return share < 1 ? from + share * (to - from) : to; }

/// A share of the turn from one direction to another; a quarter turn leaves a square what it is.
Direction turned(Direction from, Direction to, float share) {
  if (share >= 1) return to;
  constexpr float quarter = std::numbers::pi_v<float> / 2;
  const float angle = std::atan2(from.y, from.x);
  const float turn = std::remainder(std::atan2(to.y, to.x) - angle, quarter);
  return {std::cos(angle + share * turn), std::sin(angle + share * turn)};
}

/// Lloyd's method on pixels (Hausner 2001, sec. 3).
class Tiling {
 public:
  Tiling(const ViewToCut& view, ImageView<const Rgb8> picture, float tile_px)
      : cell_px_(std::max(tile_px, 2.f)),
        picture_(picture),
        surfaces_(find_surfaces(view)),
        tile_of_(picture_.width(), picture_.height(), -1),
        columns_(static_cast<int>(std::ceil(static_cast<float>(picture_.width()) / cell_px_))),
        rows_(static_cast<int>(std::ceil(static_cast<float>(picture_.height()) / cell_px_))) {
    Image<std::uint8_t> luminance(picture_.width(), picture_.height());
    cv::Mat grey = as_mat(luminance);
    cv::cvtColor(as_mat(picture_), grey, cv::COLOR_RGB2GRAY);
    field_ = OrientationField(luminance, cell_px_ / 4);
    mark_edges(luminance, cell_px_);
  }

  void lay(std::uint64_t seed) {
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) add_tile(lattice_place(seed, column, row));
    for (int round = 0; round < lloyd_rounds; ++round) {
      assign();
      move_to_centroids(1, 1);
    }
    assign();
  }

  void lay_again(std::span<const MosaicTile> before, std::uint64_t seed) {
    for (std::size_t i = 0; i < before.size(); ++i) place_again(before[i], static_cast<std::int32_t>(i));
    assign();
    move_to_centroids(move_share, turn_share);
    std::erase_if(tiles_, [&](const Tile& tile) {
      return tile.area < (tile.elsewhere ? crowded_share : gone_share) * cell_px_ * cell_px_;
    });
    assign();
    if (fill_gaps(seed)) assign();
  }

  ImageView<const Rgb8> picture() const { return picture_; }
  const Image<std::int32_t>& tile_of() const { return tile_of_; }
  const std::vector<Tile>& tiles() const { return tiles_; }

 private:
  void mark_edges(const Image<std::uint8_t>& luminance, float cell_px) {
    edges_ = Image<std::uint8_t>(luminance.width(), luminance.height());
    cv::Mat edges = as_mat(edges_);
    constexpr double weak = 40, strong = 90;
    cv::Canny(as_mat(luminance), edges, weak, strong);
    const int thickness = 2 * static_cast<int>(cell_px / 10) + 1;
    cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_RECT, {thickness, thickness}));
  }

  /// Somewhere in a cell of the lattice, the same in each frame.
  PlanePoint lattice_place(std::uint64_t seed, int column, int row) const {
    const auto jitter = [&](std::uint64_t axis) {
      return 0.25f + 0.5f * unit_float(hash_keys(
                                {seed, axis, static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(column)}));
    };
    return {(static_cast<float>(column) + jitter(0)) * cell_px_, (static_cast<float>(row) + jitter(1)) * cell_px_};
  }

  void add_tile(PlanePoint at) {
    const int px = std::clamp(static_cast<int>(at.x), 0, picture_.width() - 1);
    const int py = std::clamp(static_cast<int>(at.y), 0, picture_.height() - 1);
    if (surfaces_.of(px, py) < 0) return;
    const Rgb8 colour = picture_(px, py);
    tiles_.push_back({static_cast<float>(px) + 0.5f, static_cast<float>(py) + 0.5f, field_.along(at.x, at.y, 0, 0),
                      surfaces_.of(px, py), static_cast<float>(colour.r), static_cast<float>(colour.g),
                      static_cast<float>(colour.b)});
  }

  void place_again(const MosaicTile& before, std::int32_t index) {
    const PlanePoint at{before.x, before.y};
    const int column = static_cast<int>(std::floor(at.x)), row = static_cast<int>(std::floor(at.y));
    if (!surfaces_.of.contains(column, row) || surfaces_.of(column, row) < 0) return;
    const std::int32_t surface = surfaces_.of(column, row);
    const SampledColour now = sample(picture_, at.x, at.y);
    const float difference =
        std::max({std::abs(now.r - before.red), std::abs(now.g - before.green), std::abs(now.b - before.blue)});
    Tile tile{at.x, at.y,  {before.along_x, before.along_y}, surface, before.red, before.green, before.blue,
              0,    index, difference > new_thing_levels};
    if (tile.elsewhere) {
      tile.along = field_.along(at.x, at.y, 0, 0);
      tile.red = now.r;
      tile.green = now.g;
      tile.blue = now.b;
    }
    tiles_.push_back(tile);
  }

  /// Where much of a cell of the lattice lies far from every tile, a new one is laid on what does.
  bool fill_gaps(std::uint64_t seed) {
    struct Gap {
      int area = 0;
      float nearest = std::numeric_limits<float>::infinity();
      PlanePoint at{};
    };
    std::vector<Gap> gaps(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int y = 0; y < picture_.height(); ++y) {
      for (int x = 0; x < picture_.width(); ++x) {
        const PlanePoint at{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
        const std::int32_t tile = tile_of_(x, y);
        if (surfaces_.of(x, y) < 0 ||
            (tile >= 0 && halves_away(tiles_[static_cast<std::size_t>(tile)], at.x, at.y) < gap_halves))
          continue;
        const int cell = cell_of(at.x, at.y);
        const PlanePoint wished = lattice_place(seed, cell % columns_, cell / columns_);
        const float distance = std::hypot(at.x - wished.x, at.y - wished.y);
        Gap& gap = gaps[static_cast<std::size_t>(cell)];
        ++gap.area;
        if (distance >= gap.nearest) continue;
        gap.nearest = distance;
        gap.at = at;
      }
    }
    const std::size_t before = tiles_.size();
    for (const Gap& gap : gaps)
      if (static_cast<float>(gap.area) >= gap_share * cell_px_ * cell_px_) add_tile(gap.at);
    return tiles_.size() > before;
  }

  int cell_of(float x, float y) const {
    const int column = std::clamp(static_cast<int>(x / cell_px_), 0, columns_ - 1);
    return std::clamp(static_cast<int>(y / cell_px_), 0, rows_ - 1) * columns_ + column;
  }

  /// How far a place lies from a tile's centre by the square metric, turned, in halves of a tile.
  float halves_away(const Tile& tile, float x, float y) const {
    const float dx = x - tile.x, dy = y - tile.y;
    const float u = std::abs(dx * tile.along.x + dy * tile.along.y);
    const float v = std::abs(-dx * tile.along.y + dy * tile.along.x);
    return 2 * std::max(u, v) / cell_px_;
  }

  /// Squared distance in halves of a tile: the square metric, turned, and the difference in colour.
  float distance(const Tile& tile, float x, float y, Rgb8 colour) const {
    const float square = halves_away(tile, x, y), dx = x - tile.x, dy = y - tile.y;
    // A little of the round metric keeps the square one's ties from making stripes.
    const float round = 0.04f * (dx * dx + dy * dy) / (cell_px_ * cell_px_);
    const float red = static_cast<float>(colour.r) - tile.red, green = static_cast<float>(colour.g) - tile.green,
                blue = static_cast<float>(colour.b) - tile.blue;
    const float difference = (red * red + green * green + blue * blue) * (colour_weight / 255) * (colour_weight / 255);
    return square * square + round + difference;
  }

  void assign() {
    std::vector<std::vector<std::int32_t>> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t i = 0; i < tiles_.size(); ++i)
      cells[static_cast<std::size_t>(cell_of(tiles_[i].x, tiles_[i].y))].push_back(static_cast<std::int32_t>(i));
    tbb::parallel_for(0, picture_.height(), [&](int y) {
      for (int x = 0; x < picture_.width(); ++x) tile_of_(x, y) = nearest_tile(cells, x, y);
    });
  }

  std::int32_t nearest_tile(const std::vector<std::vector<std::int32_t>>& cells, int x, int y) const {
    const std::int32_t surface = surfaces_.of(x, y);
    if (surface < 0) return -1;
    const float fx = static_cast<float>(x) + 0.5f, fy = static_cast<float>(y) + 0.5f;
    const int cell = cell_of(fx, fy), column = cell % columns_, row = cell / columns_;
    std::int32_t best = -1;
    float least = std::numeric_limits<float>::infinity();
    for (int r = std::max(row - reach_cells, 0); r <= std::min(row + reach_cells, rows_ - 1); ++r) {
      for (int c = std::max(column - reach_cells, 0); c <= std::min(column + reach_cells, columns_ - 1); ++c) {
        for (const std::int32_t i :
             cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)]) {
          const Tile& tile = tiles_[static_cast<std::size_t>(i)];
          if (tile.surface != surface) continue;
          const float d = distance(tile, fx, fy, picture_(x, y));
          if (d >= least) continue;
          least = d;
          best = i;
        }
      }
    }
    return best;
  }

  /// Pixels on the picture's edges do not count: tiles move off them (Hausner 2001, sec. 4). Tiles go shares of the way
  /// and of the turn.
  void move_to_centroids(float way, float turn) {
    struct Sum {
      double x = 0, y = 0, weight = 0, red = 0, green = 0, blue = 0, area = 0;
    };
    std::vector<Sum> sums(tiles_.size());
    for (int y = 0; y < picture_.height(); ++y) {
      for (int x = 0; x < picture_.width(); ++x) {
        if (tile_of_(x, y) < 0) continue;
        Sum& sum = sums[static_cast<std::size_t>(tile_of_(x, y))];
        const double weight = edges_(x, y) != 0 ? 0.02 : 1;
        sum.x += weight * (x + 0.5);
        sum.y += weight * (y + 0.5);
        sum.red += weight * picture_(x, y).r;
        sum.green += weight * picture_(x, y).g;
        sum.blue += weight * picture_(x, y).b;
        sum.weight += weight;
        ++sum.area;
      }
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const Sum& sum = sums[i];
      Tile& tile = tiles_[i];
      tile.area = static_cast<float>(sum.area);
      if (sum.weight <= 0) continue;
      const auto mean = [&](double total) { return static_cast<float>(total / sum.weight); };
      tile.x = between(tile.x, mean(sum.x), way);
      tile.y = between(tile.y, mean(sum.y), way);
      tile.red = mean(sum.red);
      tile.green = mean(sum.green);
      tile.blue = mean(sum.blue);
      tile.along = turned(tile.along, field_.along(tile.x, tile.y, 0, 0), turn);
    }
  }

  float cell_px_;
  ImageView<const Rgb8> picture_;
  RegionMap surfaces_;
  Image<std::int32_t> tile_of_;
  int columns_, rows_;
  OrientationField field_;
  Image<std::uint8_t> edges_;
  std::vector<Tile> tiles_;
};

/// Gives each pixel that no tile could reach a label by its cell, so that what is left of small surfaces is tiled too.
void label_the_rest(const ViewToCut& view, float tile_px, Image<std::int32_t>& labels) {
  const int cell = std::max(static_cast<int>(2 * tile_px), 1);
  const std::int32_t first = labels.width() * labels.height();
  const int columns = labels.width() / cell + 1;
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x)
      if (labels(x, y) < 0 && (view.wanted.empty() || view.wanted(x, y) != 0))
        labels(x, y) = first + (y / cell) * columns + x / cell;
}

/// The tile that most of each region's pixels have, −1 for none; of several such regions of a tile the largest has it.
std::vector<std::int32_t> tiles_of(const RegionMap& regions, const Image<std::int32_t>& tile_of, std::size_t tiles) {
  struct Vote {
    std::int32_t tile = -1;
    int lead = 0, area = 0;
  };
  std::vector<Vote> votes(static_cast<std::size_t>(regions.count));
  for (std::size_t i = 0; i < tile_of.pixels().size(); ++i) {
    if (regions.of.pixels()[i] < 0) continue;
    Vote& vote = votes[static_cast<std::size_t>(regions.of.pixels()[i])];
    const std::int32_t tile = tile_of.pixels()[i];
    if (vote.lead == 0) vote.tile = tile;
    vote.lead += vote.tile == tile ? 1 : -1;
    ++vote.area;
  }
  std::vector<std::int32_t> region_of(tiles, -1), result(votes.size(), -1);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i].tile < 0) continue;
    std::int32_t& region = region_of[static_cast<std::size_t>(votes[i].tile)];
    if (region < 0 || votes[static_cast<std::size_t>(region)].area < votes[i].area)
      region = static_cast<std::int32_t>(i);
  }
  for (std::size_t tile = 0; tile < tiles; ++tile)
    if (region_of[tile] >= 0) result[static_cast<std::size_t>(region_of[tile])] = static_cast<std::int32_t>(tile);
  return result;
}

Tiles finished(const ViewToCut& view, float tile_px, const Tiling& tiling) {
  Image<std::int32_t> labels = tiling.tile_of();
  label_the_rest(view, tile_px, labels);
  constexpr float least_share = 0.2f;
  Tiles tiles{connected_regions(labels, view.disparity, view.depth_threshold_px), {}, {}, {}};
  tiles.regions =
      without_small_regions(std::move(tiles.regions), tiling.picture(), view.disparity, view.depth_threshold_px,
                            static_cast<std::int64_t>(least_share * tile_px * tile_px));
  tiles.tile_of = tiles_of(tiles.regions, tiling.tile_of(), tiling.tiles().size());
  for (const Tile& tile : tiling.tiles()) {
    tiles.laid.push_back({tile.x, tile.y, tile.along.x, tile.along.y, tile.red, tile.green, tile.blue,
                          static_cast<std::uint32_t>(view.number)});
    tiles.before.push_back(tile.before);
  }
  return tiles;
}

}  // namespace

Tiles lay_tiles(const ViewToCut& view, ImageView<const Rgb8> picture, float tile_px) {
  Tiling tiling(view, picture, tile_px);
  tiling.lay(view.seed);
  return finished(view, tile_px, tiling);
}

Tiles lay_tiles_again(const ViewToCut& view, ImageView<const Rgb8> picture, float tile_px,
                      std::span<const MosaicTile> before) {
  Tiling tiling(view, picture, tile_px);
  tiling.lay_again(before, view.seed);
  return finished(view, tile_px, tiling);
}

}  // namespace wheatstone
