#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "wheatstone/random.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/jitter_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {
namespace {

constexpr int passes = 2;  ///< over the cells, the second shifted by half a cell

float cell_px(const LayerPlan& plan) { return std::max(1.3f * plan.radius_px, 1.5f); }

/// Side of a block: strokes of blocks with one other between them do not meet.
int block_px(const LayerPlan& plan) {
  constexpr int least = 256;
  return std::max(2 * static_cast<int>(std::ceil(fitted_reach_px(plan.radius_px))), least);
}

/// A cell of a tile, [left, right) × [top, bottom).
struct Cell {
  int left, top, right, bottom;
  std::uint64_t random;
};

/// Where a stroke is begun: the worst pixel of a cell. Bare pixels are equally bad: chance chooses among them.
struct Anchor {
  int x = -1, y = -1;
  float sum = 0;  ///< of the cell's errors
};

Anchor find_anchor(const LayerPlan& plan, const FitTile& tile, const Cell& cell) {
  Anchor anchor;
  float most = 0;
  for (int y = cell.top; y < cell.bottom; ++y) {
    for (int x = cell.left; x < cell.right; ++x) {
      if (!plan.seeds.empty() && plan.seeds(tile.left + x, tile.top + y) == 0) continue;
      const std::size_t pixel = tile.at(x, y);
      const float error = tile.error[pixel];
      anchor.sum += error;
      const float chance = tile.is_bare(pixel) ? unit_float(hash_keys({cell.random, pixel})) : 0;
      if (error + chance <= most) continue;
      most = error + chance;
      anchor.x = x;
      anchor.y = y;
    }
  }
  return anchor;
}

/// A stroke covers several cells: where the error of one is small, none gains enough.
bool may_gain(const LayerPlan& plan, float error_of_cell) {
  constexpr float cells_of_stroke = 3;
  return cells_of_stroke * error_of_cell >= plan.least_gain;
}

/// The row or column at which half a cell begins; in both passes, a cell is two halves wide.
int place_of_half(const LayerPlan& plan, int half) {
  return static_cast<int>(static_cast<float>(half) * cell_px(plan) / 2);
}

/// Upper bounds of the errors of a row's pixels from `left` on: their errors with the largest possible weights.
void most_errors(const LayerPlan& plan, int left, int y, std::span<float> errors) {
  const auto row = [&](const auto& plane) { return plane.row(y).subspan(static_cast<std::size_t>(left)); };
  const Canvas& canvas = plan.canvas;
  const auto red = row(plan.reference.red), green = row(plan.reference.green), blue = row(plan.reference.blue);
  const auto painted_red = row(canvas.red), painted_green = row(canvas.green), painted_blue = row(canvas.blue);
  const auto covered = row(canvas.coverage);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    // The planes are linear in sRGB.
    const float difference =
        squared(FitColour::of(red[i] - painted_red[i], green[i] - painted_green[i], blue[i] - painted_blue[i]));
    errors[i] = covered[i] < 0.5f ? squared_error_of_bare : difference;
  }
  if (weighs_outlines(plan)) {
    const auto outline = row(plan.depth_edges);
    for (std::size_t i = 0; i < errors.size(); ++i)
      if (outline[i] != 0) errors[i] *= weight_of_outline;
  }
  if (plan.view.detail.empty()) return;
  const auto detail = row(plan.view.detail);
  const std::array<float, 256>& of_detail = detail_weights();
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] *= std::max(of_detail[detail[i]], 1.f);
}

/// Whether a stroke may gain in some cell of a block if each pixel has the largest possible weight. It saves a closer
/// look at most blocks of the finer layers of a large picture.
bool may_gain_in_block(const LayerPlan& plan, int left, int top, int size) {
  const int reach = size + 2 * static_cast<int>(cell_px(plan));
  const int right = std::min(left + reach, plan.canvas.width), bottom = std::min(top + reach, plan.canvas.height);
  const auto half_before = [&](int place) {
    return std::max(static_cast<int>(2 * static_cast<float>(place) / cell_px(plan)) - 1, 0);
  };
  const int first_column = half_before(left), first_row = half_before(top), x0 = place_of_half(plan, first_column);
  std::vector<std::size_t> columns;  // first pixel of each half cell, from x0, and the end
  for (int half = first_column; place_of_half(plan, half) < right; ++half)
    columns.push_back(static_cast<std::size_t>(place_of_half(plan, half) - x0));
  columns.push_back(static_cast<std::size_t>(right - x0));
  std::vector<float> errors(columns.back()), above(columns.size()), sums(columns.size());
  for (int row = first_row; place_of_half(plan, row) < bottom; ++row) {
    std::ranges::fill(sums, 0.f);
    for (int y = place_of_half(plan, row); y < std::min(place_of_half(plan, row + 1), bottom); ++y) {
      most_errors(plan, x0, y, errors);
      for (std::size_t c = 0; c + 1 < columns.size(); ++c)
        for (std::size_t x = columns[c]; x < columns[c + 1]; ++x) sums[c] += errors[x];
    }
    for (std::size_t c = 0; c + 1 < columns.size(); ++c)
      if (may_gain(plan, above[c] + above[c + 1] + sums[c] + sums[c + 1])) return true;
    std::swap(above, sums);
  }
  return false;
}

/// The cells of one pass that begin in a block and in which a stroke may gain, in random order, so that no rows of
/// strokes show.
std::vector<Cell> cells_of_block(const LayerPlan& plan, const FitTile& tile, int left, int top, int size, int pass) {
  const float cell = cell_px(plan), shift = static_cast<float>(pass) * cell / 2;
  const auto first = [&](int place) { return static_cast<int>(std::ceil((static_cast<float>(place) + shift) / cell)); };
  const auto place = [&](int number) { return place_of_half(plan, 2 * number - pass); };
  std::vector<Cell> cells;
  const auto number_from = [&](int begin) { return begin == 0 ? 0 : first(begin); };
  for (int row = number_from(top); row < first(top + size); ++row) {
    for (int column = number_from(left); column < first(left + size); ++column) {
      const Cell in_tile{
          std::max(place(column) - tile.left, 0), std::max(place(row) - tile.top, 0),
          std::min(place(column + 1) - tile.left, tile.width), std::min(place(row + 1) - tile.top, tile.height),
          hash_keys({plan.style.seed, static_cast<std::uint64_t>(plan.layer), static_cast<std::uint64_t>(pass),
                     static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)})};
      if (may_gain(plan, find_anchor(plan, tile, in_tile).sum)) cells.push_back(in_tile);
    }
  }
  std::ranges::sort(cells, {}, &Cell::random);
  return cells;
}

std::uint8_t level_of(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); }

void add_stroke(const FittedStroke& fitted, const LayerPlan& plan, const FitTile& tile, std::uint64_t random,
                Layer& layer) {
  Stroke stroke;
  stroke.first_point = static_cast<std::uint32_t>(layer.points.size());
  stroke.point_count = static_cast<std::uint32_t>(fitted.points.size());
  for (const PlanePoint& point : fitted.points)
    layer.points.push_back({static_cast<float>(tile.left) + point.x, static_cast<float>(tile.top) + point.y,
                            tile.disparity[tile.at(static_cast<int>(point.x), static_cast<int>(point.y))]});
  const std::span points = std::span(layer.points).subspan(stroke.first_point);
  settle_disparities(plan, fitted.radius_px, points);
  stroke.radius_px = fitted.radius_px;
  stroke.opacity = plan.style.opacity;
  const auto begin = fitted.begin.rgb(), end = fitted.end.rgb();
  const Rgb8 first{level_of(begin[0]), level_of(begin[1]), level_of(begin[2])};
  const Rgb8 last{level_of(end[0]), level_of(end[1]), level_of(end[2])};
  const auto change = [](int from, int to) { return static_cast<std::int16_t>(to - from); };
  stroke.colour = jittered(first, plan.style.jitter, random);
  stroke.change = {change(first.r, last.r), change(first.g, last.g), change(first.b, last.b)};
  stroke.disparity = points[points.size() / 2].disparity;
  stroke.reference_view = plan.view.position;
  stroke.views = all_views;
  layer.strokes.push_back(stroke);
}

PaintedPicture painted_picture(const Canvas& canvas) {
  PaintedPicture picture(canvas.width, canvas.height);
  tbb::parallel_for(0, canvas.height, [&](int y) {
    const auto red = canvas.red.row(y), green = canvas.green.row(y), blue = canvas.blue.row(y);
    const auto covered = canvas.coverage.row(y);
    const auto to = picture.row(y);
    for (std::size_t x = 0; x < to.size(); ++x) to[x] = PaintedPixel::of(red[x], green[x], blue[x], covered[x]);
  });
  return picture;
}

/// Whether a stroke may begin in a block.
bool has_seeds(const LayerPlan& plan, int left, int top, int size) {
  if (plan.seeds.empty()) return true;
  const int right = std::min(left + size, plan.seeds.width()), bottom = std::min(top + size, plan.seeds.height());
  for (int y = top; y < bottom; ++y) {
    const auto row = plan.seeds.row(y).subspan(static_cast<std::size_t>(left), static_cast<std::size_t>(right - left));
    if (std::ranges::any_of(row, [](std::uint8_t seed) { return seed != 0; })) return true;
  }
  return false;
}

Layer plan_block(const LayerPlan& plan, int left, int top, int size, PaintedPicture& canvas) {
  Layer layer{plan.radius_px, {}, {}};
  const int margin = static_cast<int>(std::ceil(fitted_reach_px(plan.radius_px)));
  FitTile tile(plan, canvas, left - margin, top - margin, left + size + margin, top + size + margin);
  std::vector<std::uint8_t> tried_in_vain(tile.wanted.size());  // by pixel
  for (int pass = 0; pass < passes; ++pass) {
    for (const Cell& cell : cells_of_block(plan, tile, left, top, size, pass)) {
      const Anchor anchor = find_anchor(plan, tile, cell);
      if (anchor.x < 0 || !may_gain(plan, anchor.sum)) continue;
      std::uint8_t& in_vain = tried_in_vain[tile.at(anchor.x, anchor.y)];
      if (in_vain != 0) continue;
      const auto fitted = fit_stroke(tile, plan, anchor.x, anchor.y, cell.random);
      in_vain = !fitted;
      if (!fitted) continue;
      paint_stroke(*fitted, plan, tile, canvas);
      add_stroke(*fitted, plan, tile, cell.random, layer);
    }
  }
  return layer;
}

}  // namespace

Layer fit_layer(const LayerPlan& plan) {
  const int size = block_px(plan);
  const int columns = (plan.canvas.width + size - 1) / size, rows = (plan.canvas.height + size - 1) / size;
  Layer layer{plan.radius_px, {}, {}};
  std::vector<std::uint8_t> worth(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  tbb::parallel_for(0, columns * rows, [&](int i) {
    const int left = i % columns * size, top = i / columns * size;
    worth[i] = has_seeds(plan, left, top, size) && may_gain_in_block(plan, left, top, size);
  });
  if (std::ranges::none_of(worth, [](std::uint8_t block) { return block != 0; })) return layer;
  PaintedPicture canvas = painted_picture(plan.canvas);
  // Blocks of one wave do not touch the same pixels. A stroke depends on the picture within four blocks of this layer,
  // and as much for each coarser one.
  for (int wave = 0; wave < 4; ++wave) {
    const int first_column = wave % 2, first_row = wave / 2;
    const int wave_columns = (columns - first_column + 1) / 2, wave_rows = (rows - first_row + 1) / 2;
    std::vector<Layer> blocks(static_cast<std::size_t>(std::max(wave_columns, 0)) *
                              static_cast<std::size_t>(std::max(wave_rows, 0)));
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      const int column = first_column + 2 * (static_cast<int>(i) % wave_columns);
      const int row = first_row + 2 * (static_cast<int>(i) / wave_columns);
      if (worth[row * columns + column] != 0) blocks[i] = plan_block(plan, column * size, row * size, size, canvas);
    });
    for (const Layer& block : blocks) append_strokes(block, layer);
  }
  return layer;
}

}  // namespace wheatstone
