#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/random.h"
#include "wheatstone/strokes/begun_canvas_internal.h"
#include "wheatstone/strokes/jitter_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/refit_internal.h"
#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {
namespace {

float cell_px(const LayerPlan& plan) { return std::max(1.3f * plan.radius_px, 1.5f); }

/// Side of a block: strokes of blocks with one other between them do not meet.
int block_px(const LayerPlan& plan) {
  constexpr int least = 256;
  return std::max(2 * static_cast<int>(std::ceil(fitted_reach_px(plan.radius_px))), least);
}

/// A cell of a tile, [left, right) × [top, bottom).
struct Cell {
  int left, top, right, bottom;
  std::size_t index;    ///< in its block and pass
  std::uint32_t place;  ///< in the order in which the layer's cells are planned, with gaps
};

std::uint64_t random_of(const LayerPlan& plan, const Cell& cell) {
  return hash_keys({plan.style.seed, static_cast<std::uint64_t>(plan.layer), cell.place});
}

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
      const float error = tile.error(x, y);
      anchor.sum += error;
      const float chance = tile.is_bare(x, y) ? unit_float(hash_keys({plan.style.seed, cell.place, tile.at(x, y)})) : 0;
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

/// Whether a stroke may gain in some cell of a block. It saves a closer look at most blocks of the finer layers of a
/// large picture.
bool may_gain_in_block(const LayerPlan& plan, const PaintedPicture& canvas, int left, int top, int size) {
  const int reach = size + 2 * static_cast<int>(cell_px(plan));
  const int right = std::min(left + reach, canvas.width()), bottom = std::min(top + reach, canvas.height());
  const auto half_before = [&](int place) {
    return std::max(static_cast<int>(2 * static_cast<float>(place) / cell_px(plan)) - 1, 0);
  };
  const int first_column = half_before(left), first_row = half_before(top), x0 = place_of_half(plan, first_column);
  std::vector<std::size_t> columns;  // first pixel of each half cell, from x0, and the end
  for (int half = first_column; place_of_half(plan, half) < right; ++half)
    columns.push_back(static_cast<std::size_t>(place_of_half(plan, half) - x0));
  columns.push_back(static_cast<std::size_t>(right - x0));
  const int y0 = place_of_half(plan, first_row);
  const std::vector<float> weights = difference_weights(plan, {x0, y0, right, bottom});
  std::vector<float> errors(columns.back()), above(columns.size()), sums(columns.size());
  for (int row = first_row; place_of_half(plan, row) < bottom; ++row) {
    std::ranges::fill(sums, 0.f);
    for (int y = place_of_half(plan, row); y < std::min(place_of_half(plan, row + 1), bottom); ++y) {
      errors_of_row(plan, canvas, x0, y,
                    std::span(weights).subspan(static_cast<std::size_t>(y - y0) * errors.size(), errors.size()),
                    errors);
      for (std::size_t c = 0; c + 1 < columns.size(); ++c)
        for (std::size_t x = columns[c]; x < columns[c + 1]; ++x) sums[c] += errors[x];
    }
    for (std::size_t c = 0; c + 1 < columns.size(); ++c)
      if (may_gain(plan, above[c] + above[c + 1] + sums[c] + sums[c + 1])) return true;
    std::swap(above, sums);
  }
  return false;
}

/// A block of cells, and the part of the picture that its strokes may touch.
struct Block {
  int left, top, size, wave;
  PixelArea area;
  std::size_t index;  ///< in the order in which blocks are planned
};

/// The number of bits of a cell's place among those of a pass over a block.
int bits_of_place(const LayerPlan& plan) {
  const auto side = static_cast<unsigned>(static_cast<float>(block_px(plan)) / cell_px(plan)) + 2;
  return std::bit_width(side * side - 1);
}

/// Another number of so many bits for each number of so many bits, as if by chance.
std::uint32_t shuffled(std::uint32_t number, int bits, std::uint64_t key) {
  const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
  std::uint32_t mixed = (number + static_cast<std::uint32_t>(key)) & mask;
  for (int i = 0; i < 3; ++i) {
    mixed = mixed * 0x9E3779B1u & mask;  // each step can be undone, so that no number comes twice
    mixed ^= mixed >> ((bits + 1) / 2);
  }
  return mixed;
}

/// The pixels of a tile at which the columns or rows of cells begin that begin in a block, and where the last one ends.
std::vector<int> begins_of_cells(const LayerPlan& plan, int begin, int size, int pass, int tile_begin, int tile_size) {
  const float cell = cell_px(plan), shift = static_cast<float>(pass) * cell / 2;
  const auto first = [&](int place) { return static_cast<int>(std::ceil((static_cast<float>(place) + shift) / cell)); };
  std::vector<int> begins;
  for (int number = begin == 0 ? 0 : first(begin); number <= first(begin + size); ++number)
    begins.push_back(std::clamp(place_of_half(plan, 2 * number - pass) - tile_begin, 0, tile_size));
  return begins;
}

/// The cells of one pass that begin in a block, counted row by row.
class CellsOfBlock {
 public:
  CellsOfBlock(const LayerPlan& plan, const FitTile& tile, const Block& block, int pass)
      : columns_(begins_of_cells(plan, block.left, block.size, pass, tile.left, tile.width)),
        rows_(begins_of_cells(plan, block.top, block.size, pass, tile.top, tile.height)),
        pass_of_block_(static_cast<std::uint32_t>(fit_passes * block.index + static_cast<std::size_t>(pass))) {}

  std::size_t count() const { return (columns_.size() - 1) * (rows_.size() - 1); }

  /// The cells in which a stroke may gain, in random order, so that no rows of strokes show.
  std::vector<Cell> promising(const LayerPlan& plan, const FitTile& tile) const {
    const int bits = bits_of_place(plan);
    const std::uint64_t key = hash_keys({plan.style.seed, static_cast<std::uint64_t>(plan.layer), pass_of_block_});
    const std::size_t columns = columns_.size() - 1;
    std::vector<std::optional<std::uint16_t>> at_place(std::size_t{1} << bits);
    std::vector<float> sums(columns);
    for (std::size_t row = 0; row + 1 < rows_.size(); ++row) {
      sum_errors(tile, row, sums);
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t index = row * columns + column;
        if (may_gain(plan, sums[column]))
          at_place[shuffled(static_cast<std::uint32_t>(index), bits, key)] = static_cast<std::uint16_t>(index);
      }
    }
    std::vector<Cell> cells;
    for (std::uint32_t place = 0; place < at_place.size(); ++place) {
      if (!at_place[place]) continue;
      const std::size_t row = *at_place[place] / columns, column = *at_place[place] % columns;
      cells.push_back({columns_[column], rows_[row], columns_[column + 1], rows_[row + 1], *at_place[place],
                       (pass_of_block_ << bits) + place});
    }
    return cells;
  }

 private:
  /// The sums of the errors in a row of cells, also where no stroke may begin.
  void sum_errors(const FitTile& tile, std::size_t row, std::span<float> sums) const {
    std::ranges::fill(sums, 0.f);
    for (int y = rows_[row]; y < rows_[row + 1]; ++y)
      for (std::size_t column = 0; column < sums.size(); ++column)
        for (int x = columns_[column]; x < columns_[column + 1]; ++x) sums[column] += tile.error(x, y);
  }

  std::vector<int> columns_, rows_;
  std::uint32_t pass_of_block_;
};

std::uint8_t level_of(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); }

/// `left`, `top`: the first pixel of the tile in which the stroke was fitted.
void add_stroke(const PaintedStroke& painted, const LayerPlan& plan, int left, int top, Layer& layer) {
  const FittedStroke& fitted = painted.stroke;
  Stroke stroke;
  stroke.first_point = static_cast<std::uint32_t>(layer.points.size());
  stroke.point_count = static_cast<std::uint32_t>(fitted.points.size());
  for (const PlanePoint& point : fitted.points)
    layer.points.push_back({static_cast<float>(left) + point.x, static_cast<float>(top) + point.y,
                            plan.view.disparity(left + static_cast<int>(point.x), top + static_cast<int>(point.y))});
  const std::span points = std::span(layer.points).subspan(stroke.first_point);
  settle_disparities(plan, fitted.radius_px, points);
  stroke.radius_px = fitted.radius_px;
  stroke.opacity = plan.style.opacity;
  const auto begin = fitted.begin.rgb(), end = fitted.end.rgb();
  const Rgb8 first{level_of(begin[0]), level_of(begin[1]), level_of(begin[2])};
  const Rgb8 last{level_of(end[0]), level_of(end[1]), level_of(end[2])};
  const auto change = [](int from, int to) { return static_cast<std::int16_t>(to - from); };
  stroke.colour = jittered(first, plan.style.jitter, painted.random);
  stroke.change = {change(first.r, last.r), change(first.g, last.g), change(first.b, last.b)};
  stroke.disparity = points[points.size() / 2].disparity;
  stroke.reference_view = plan.view.position;
  stroke.views = all_views;
  stroke.number = painted.number;
  layer.strokes.push_back(stroke);
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

/// Plans the strokes of one block, or takes over those of the last time where nothing about a cell differs.
class BlockPlan {
 public:
  BlockPlan(const LayerPlan& plan, const Block& block, PaintedPicture& canvas, Refit* refit)
      : plan_(plan),
        block_(block),
        canvas_(canvas),
        refit_(refit),
        before_(refit == nullptr ? BlockOutcome() : std::exchange(refit->block(block.index), {})) {}

  Layer run() {
    if (refit_ != nullptr && !before_.cells.front().empty() && !refit_->differs(block_.area)) {
      now_ = std::move(before_);
      return end();
    }
    if (refit_ != nullptr) refit_->restore(block_.wave, block_.area, canvas_);
    FitTile tile(plan_, canvas_, block_.area.left, block_.area.top, block_.area.right, block_.area.bottom);
    tried_in_vain_.resize(tile.at(0, tile.height));
    for (int pass = 0; pass < fit_passes; ++pass) run_pass(pass, tile);
    return end();
  }

  /// Leaves the block without strokes.
  void drop() {
    if (before_.strokes.empty()) return;
    refit_->restore(block_.wave, block_.area, canvas_);
    for (const PaintedStroke& painted : before_.strokes) mark(painted.stroke);
  }

 private:
  void run_pass(int pass, FitTile& tile) {
    const CellsOfBlock cells(plan_, tile, block_, pass);
    const std::vector<Cell> promising = cells.promising(plan_, tile);
    std::vector<CellOutcome>& outcomes = now_.cells[static_cast<std::size_t>(pass)];
    outcomes.resize(cells.count());
    const std::vector<CellOutcome>& known = before_.cells[static_cast<std::size_t>(pass)];
    for (const Cell& cell : promising) outcomes[cell.index].kind = CellOutcome::Kind::left_out;
    for (std::size_t i = 0; i < known.size(); ++i)
      if (outcomes[i].kind == CellOutcome::Kind::no_gain) replace(known[i], nullptr);
    for (const Cell& cell : promising) {
      const CellOutcome before = known.empty() ? CellOutcome() : known[cell.index];
      outcomes[cell.index] =
          known.empty() || differs_about(cell) ? plan_cell(cell, before, tile) : take_over(before, tile);
    }
  }

  CellOutcome plan_cell(const Cell& cell, const CellOutcome& before, FitTile& tile) {
    const Anchor anchor = find_anchor(plan_, tile, cell);
    const std::uint64_t random = random_of(plan_, cell);
    std::optional<FittedStroke> fitted;
    CellOutcome outcome{CellOutcome::Kind::left_out};
    if (anchor.x >= 0 && may_gain(plan_, anchor.sum)) {
      const std::size_t pixel = tile.at(anchor.x, anchor.y);
      if (tried_in_vain_[pixel] == 0) {
        fitted = fit_stroke(tile, plan_, anchor.x, anchor.y, random);
        tried_in_vain_[pixel] = !fitted;
        outcome = {CellOutcome::Kind::in_vain, static_cast<std::uint32_t>(pixel)};
      }
    }
    replace(before, fitted ? &*fitted : nullptr);
    if (!fitted) return outcome;
    return paint({std::move(*fitted), random, 1 + cell.place}, tile);
  }

  CellOutcome take_over(const CellOutcome& before, FitTile& tile) {
    if (before.kind == CellOutcome::Kind::painted) return paint(std::move(before_.strokes[before.place]), tile);
    if (before.kind == CellOutcome::Kind::in_vain) tried_in_vain_[before.place] = 1;
    return before;
  }

  CellOutcome paint(PaintedStroke painted, FitTile& tile) {
    paint_stroke(painted.stroke, plan_, tile);
    now_.strokes.push_back(std::move(painted));
    return {CellOutcome::Kind::painted, static_cast<std::uint32_t>(now_.strokes.size() - 1)};
  }

  /// Whether anything differs that a stroke begun in a cell may depend on.
  bool differs_about(const Cell& cell) const {
    const int reach = static_cast<int>(std::ceil(fitted_reach_px(plan_.radius_px)));
    return refit_->differs(within_area({cell.left - reach, cell.top - reach, cell.right + reach, cell.bottom + reach}));
  }

  /// Notes what differs when a cell's stroke gives way to another one, or to none.
  void replace(const CellOutcome& before, const FittedStroke* now) {
    if (refit_ == nullptr) return;
    const bool was_painted = before.kind == CellOutcome::Kind::painted;
    if (was_painted && now != nullptr && before_.strokes[before.place].stroke == *now) return;
    if (was_painted) mark(before_.strokes[before.place].stroke);
    if (now != nullptr) mark(*now);
  }

  void mark(const FittedStroke& stroke) {
    const int reach = static_cast<int>(std::ceil(BrushProfile(stroke.radius_px).reach_px)) + 1;
    const auto [left, right] = std::ranges::minmax(stroke.points, {}, &PlanePoint::x);
    const auto [top, bottom] = std::ranges::minmax(stroke.points, {}, &PlanePoint::y);
    refit_->mark(within_area({static_cast<int>(left.x) - reach, static_cast<int>(top.y) - reach,
                              static_cast<int>(right.x) + reach + 1, static_cast<int>(bottom.y) + reach + 1}));
  }

  /// A part of the tile in pixels of the picture. Other blocks of the wave have all others.
  PixelArea within_area(const PixelArea& part) const {
    const auto& [left, top, right, bottom] = block_.area;
    return {std::max(left + part.left, left), std::max(top + part.top, top), std::min(left + part.right, right),
            std::min(top + part.bottom, bottom)};
  }

  Layer end() {
    Layer layer{plan_.radius_px, {}, {}};
    for (const PaintedStroke& painted : now_.strokes)
      add_stroke(painted, plan_, block_.area.left, block_.area.top, layer);
    if (refit_ != nullptr) refit_->block(block_.index) = std::move(now_);
    return layer;
  }

  const LayerPlan& plan_;
  const Block& block_;
  PaintedPicture& canvas_;
  Refit* refit_;         ///< none: nothing is known, and nothing kept
  BlockOutcome before_;  ///< of the last time
  BlockOutcome now_;
  std::vector<std::uint8_t> tried_in_vain_;  ///< by pixel of the tile
};

/// The picture's blocks in the order in which they are planned.
std::vector<Block> blocks_of(const LayerPlan& plan) {
  const int size = block_px(plan), margin = static_cast<int>(std::ceil(fitted_reach_px(plan.radius_px)));
  const int width = plan.canvas.width, height = plan.canvas.height;
  std::vector<Block> blocks;
  for (int top = 0; top < height; top += size)
    for (int left = 0; left < width; left += size)
      blocks.push_back({left,
                        top,
                        size,
                        left / size % 2 + 2 * (top / size % 2),
                        {std::max(left - margin, 0), std::max(top - margin, 0), std::min(left + size + margin, width),
                         std::min(top + size + margin, height)}});
  std::ranges::stable_sort(blocks, {}, &Block::wave);
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].index = i;
  return blocks;
}

}  // namespace

std::uint32_t fitted_places(const LayerPlan& plan) {
  return static_cast<std::uint32_t>(fit_passes * blocks_of(plan).size()) << bits_of_place(plan);
}

void take_painted_row(const Canvas& canvas, int y, std::span<PaintedPixel> to) {
  const auto red = canvas.red.row(y), green = canvas.green.row(y), blue = canvas.blue.row(y);
  const auto covered = canvas.coverage.row(y);
  for (std::size_t x = 0; x < to.size(); ++x) to[x] = PaintedPixel::of(red[x], green[x], blue[x], covered[x]);
}

PaintedPicture painted_picture(const BegunCanvas& begun) {
  PaintedPicture picture(begun.width, begun.height);
  for_each_row(begun, [&](const Canvas& canvas, int row, int y) { take_painted_row(canvas, row, picture.row(y)); });
  return picture;
}

Layer fit_layer(const LayerPlan& plan, PaintedPicture own_canvas) {
  const std::vector<Block> blocks = blocks_of(plan);
  LayerFit fit;  // what is left half done by an error is not kept
  std::optional<Refit> refit;
  if (plan.fit != nullptr) {
    fit = std::exchange(*plan.fit, {});
    refit.emplace(plan, blocks.size(), fit);
  } else if (own_canvas.empty()) {
    own_canvas = painted_picture(plan.canvas);
  }
  const PaintedPicture& begun = refit ? refit->begun() : own_canvas;
  std::vector<std::uint8_t> worth(blocks.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    const auto& [left, top, size, wave, area, index] = blocks[i];
    worth[i] = refit && !refit->differs(area)
                   ? refit->was_worth(index)
                   : has_seeds(plan, left, top, size) && may_gain_in_block(plan, begun, left, top, size);
  });
  Layer layer{plan.radius_px, {}, {}};
  const bool any = std::ranges::any_of(worth, [](std::uint8_t block) { return block != 0; });
  if (!any && !refit) return layer;
  PaintedPicture& canvas = refit ? refit->canvas() : own_canvas;
  // Blocks of one wave do not touch the same pixels. A stroke depends on the picture within four blocks of this layer,
  // and as much for each coarser one.
  for (int wave = 0; wave < fit_waves; ++wave) {
    std::vector<Layer> planned(blocks.size());
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      if (blocks[i].wave != wave) return;
      BlockPlan block(plan, blocks[i], canvas, refit ? &*refit : nullptr);
      if (worth[i] != 0)
        planned[i] = block.run();
      else
        block.drop();
    });
    for (const Layer& block : planned) append_strokes(block, layer);
    if (refit) refit->end_wave(wave);
  }
  if (refit) {
    refit->mark_rows();
    *plan.fit = std::move(fit);
  }
  return layer;
}

}  // namespace wheatstone
