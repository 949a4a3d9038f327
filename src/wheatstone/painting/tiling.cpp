#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/painting/orientation_field_internal.h"
#include "wheatstone/painting/tiling_internal.h"
#include "wheatstone/random.h"

namespace wheatstone {
namespace {

struct Tile {
  float x = 0, y = 0;
  Direction along;
  std::int32_t surface = -1;
  float red = 0, green = 0, blue = 0;  ///< mean colour
};

/// How much a tile's shape gives way to the picture's colours: a difference of 255 in one channel is as far as this
/// many tiles' halves.
constexpr float colour_weight = 3;
constexpr int lloyd_rounds = 30;
/// A pixel asks the tiles of the 5 × 5 cells around its own.
constexpr int reach_cells = 2;

/// The surfaces of the picture, each a connected region.
RegionMap find_surfaces(const ViewToCut& view) {
  Image<std::int32_t> labels(view.disparity.width(), view.disparity.height());
  if (!view.mask.empty())
    for (int y = 0; y < labels.height(); ++y)
      for (int x = 0; x < labels.width(); ++x) labels(x, y) = view.mask(x, y) != 0 ? 0 : -1;
  return connected_regions(labels, view.disparity, view.depth_threshold_px);
}

/// Lloyd's method on pixels (Hausner 2001, sec. 3).
class Tiling {
 public:
  Tiling(const ViewToCut& view, float tile_px)
      : cell_px_(std::max(tile_px, 2.f)),
        picture_(without_grain(view.photograph, view.scale)),
        surfaces_(find_surfaces(view)),
        tile_of_(picture_.width(), picture_.height(), -1),
        columns_(static_cast<int>(std::ceil(static_cast<float>(picture_.width()) / cell_px_))),
        rows_(static_cast<int>(std::ceil(static_cast<float>(picture_.height()) / cell_px_))) {
    Image<std::uint8_t> luminance(picture_.width(), picture_.height());
    cv::Mat grey = as_mat(luminance);
    cv::cvtColor(as_mat(picture_), grey, cv::COLOR_RGB2GRAY);
    field_ = OrientationField(luminance, cell_px_ / 4);
    mark_edges(luminance, cell_px_);
    place_tiles(view.seed);
  }

  Image<std::int32_t> lay() {
    for (int round = 0; round < lloyd_rounds; ++round) {
      assign();
      move_to_centroids();
    }
    assign();
    return std::move(tile_of_);
  }
  const Image<Rgb8>& picture() const { return picture_; }

 private:
  void mark_edges(const Image<std::uint8_t>& luminance, float cell_px) {
    edges_ = Image<std::uint8_t>(luminance.width(), luminance.height());
    cv::Mat edges = as_mat(edges_);
    constexpr double weak = 40, strong = 90;
    cv::Canny(as_mat(luminance), edges, weak, strong);
    const int thickness = 2 * static_cast<int>(cell_px / 10) + 1;
    cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_RECT, {thickness, thickness}));
  }

  void place_tiles(std::uint64_t seed) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto jitter = [&](std::uint64_t axis) {
          return 0.25f + 0.5f * unit_float(hash(
                                    {seed, axis, static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(column)}));
        };
        add_tile((static_cast<float>(column) + jitter(0)) * cell_px_, (static_cast<float>(row) + jitter(1)) * cell_px_);
      }
    }
  }

  void add_tile(float x, float y) {
    const int px = std::clamp(static_cast<int>(x), 0, picture_.width() - 1);
    const int py = std::clamp(static_cast<int>(y), 0, picture_.height() - 1);
    if (surfaces_.of(px, py) < 0) return;
    const Rgb8 colour = picture_(px, py);
    tiles_.push_back({static_cast<float>(px) + 0.5f, static_cast<float>(py) + 0.5f, field_.along(x, y, 0, 0),
                      surfaces_.of(px, py), static_cast<float>(colour.r), static_cast<float>(colour.g),
                      static_cast<float>(colour.b)});
  }

  int cell_of(float x, float y) const {
    const int column = std::clamp(static_cast<int>(x / cell_px_), 0, columns_ - 1);
    return std::clamp(static_cast<int>(y / cell_px_), 0, rows_ - 1) * columns_ + column;
  }

  /// Squared distance in halves of a tile: the square metric, turned, and the difference in colour.
  float distance(const Tile& tile, float x, float y, Rgb8 colour) const {
    const float dx = x - tile.x, dy = y - tile.y;
    const float u = std::abs(dx * tile.along.x + dy * tile.along.y);
    const float v = std::abs(-dx * tile.along.y + dy * tile.along.x);
    const float square = 2 * std::max(u, v) / cell_px_;
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

  /// Pixels on the picture's edges do not count: tiles move off them (Hausner 2001, sec. 4).
  void move_to_centroids() {
    struct Sum {
      double x = 0, y = 0, weight = 0, red = 0, green = 0, blue = 0;
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
      }
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const Sum& sum = sums[i];
      if (sum.weight <= 0) continue;
      Tile& tile = tiles_[i];
      const auto mean = [&](double total) { return static_cast<float>(total / sum.weight); };
      tile.x = mean(sum.x);
      tile.y = mean(sum.y);
      tile.red = mean(sum.red);
      tile.green = mean(sum.green);
      tile.blue = mean(sum.blue);
      tile.along = field_.along(tile.x, tile.y, 0, 0);
    }
  }

  float cell_px_;
  Image<Rgb8> picture_;
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
      if (labels(x, y) < 0 && (view.mask.empty() || view.mask(x, y) != 0))
        labels(x, y) = first + (y / cell) * columns + x / cell;
}

}  // namespace

RegionMap lay_tiles(const ViewToCut& view, float tile_px) {
  Tiling tiling(view, tile_px);
  Image<std::int32_t> labels = tiling.lay();
  label_the_rest(view, tile_px, labels);
  RegionMap regions = connected_regions(labels, view.disparity, view.depth_threshold_px);
  constexpr float least_share = 0.2f;
  return without_small_regions(std::move(regions), tiling.picture(), view.disparity, view.depth_threshold_px,
                               static_cast<std::int64_t>(least_share * tile_px * tile_px));
}

}  // namespace wheatstone
