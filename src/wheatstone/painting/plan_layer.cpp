#include "wheatstone/painting/plan_layer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/painting/jitter.h"
#include "wheatstone/painting/layer_order.h"
#include "wheatstone/painting/plan_layer_internal.h"
#include "wheatstone/painting/random.h"
#include "wheatstone/painting/trace_stroke.h"

namespace wheatstone {
namespace {

/// A grid of cells f_g·R wide; the last row and column may be cut off by the picture's edge.
struct Grid {
  Grid(const LayerPlan& plan, const Style& style)
      : cell_px(std::max(style.grid * plan.radius_px, 1.f)), width(plan.canvas.width), height(plan.canvas.height) {}

  int columns() const { return static_cast<int>(std::ceil(static_cast<float>(width) / cell_px)); }
  int rows() const { return static_cast<int>(std::ceil(static_cast<float>(height) / cell_px)); }
  int left(int column) const { return std::min(static_cast<int>(static_cast<float>(column) * cell_px), width); }
  int top(int row) const { return std::min(static_cast<int>(static_cast<float>(row) * cell_px), height); }

  float cell_px;
  int width, height;
};

/// The best pixel found in a cell so far.
struct Seed {
  float error = -1;
  int x = 0, y = 0;
};

/// Where on a bare cell a stroke would begin: the jitter of the grid.
struct Target {
  float x, y;
};

bool may_begin(const LayerPlan& plan, int x, int y) {
  if (!plan.seeds.empty() && plan.seeds(x, y) == 0) return false;
  if (!plan.mixed_colours.empty() && plan.mixed_colours(x, y) != 0) return false;
  return plan.finest || plan.depth_edges.empty() || plan.depth_edges(x, y) == 0;
}

/// Looks through one row of one cell for a pixel with a larger error than the seed's. Among bare pixels, which are all
/// infinitely wrong, the one nearest to the cell's target wins.
void improve_seed(const LayerPlan& plan, const float* errors, int begin, int end, int y, const Target& target,
                  Seed& seed) {
  for (int x = begin; x < end; ++x) {
    float error = errors[x];
    if (error >= bare_error) {
      const float dx = static_cast<float>(x) - target.x, dy = static_cast<float>(y) - target.y;
      error = bare_error - std::min(dx * dx + dy * dy, bare_error / 2);
    }
    if (error > seed.error && may_begin(plan, x, y)) seed = {error, x, y};
  }
}

bool has_seeds(const LayerPlan& plan, int y) {
  if (plan.seeds.empty()) return true;
  const auto row = plan.seeds.row(y);
  return std::ranges::any_of(row, [](std::uint8_t seed) { return seed != 0; });
}

std::uint64_t cell_hash(const LayerPlan& plan, const Style& style, int column, int row, std::uint64_t purpose) {
  return hash({style.seed, static_cast<std::uint64_t>(plan.layer), static_cast<std::uint64_t>(column),
               static_cast<std::uint64_t>(row), plan.view < 0 ? 0ull : 1ull, purpose});
}

void add_stroke(const LayerPlan& plan, const Style& style, const Seed& seed, std::uint64_t random, Layer& layer) {
  Stroke stroke;
  stroke.first_point = static_cast<std::uint32_t>(layer.points.size());
  trace_stroke(plan, style, seed.x, seed.y, (random & 1) != 0, layer.points);
  stroke.point_count = static_cast<std::uint32_t>(layer.points.size()) - stroke.first_point;
  stroke.radius_px = plan.radius_px;
  stroke.opacity = style.opacity;
  const ReferencePicture& reference = plan.reference;
  stroke.colour = jittered({reference.red(seed.x, seed.y), reference.green(seed.x, seed.y),
                            reference.blue(seed.x, seed.y)}, style.jitter, random);
  stroke.disparity = plan.disparity(seed.x, seed.y);
  stroke.reference_view = plan.view;
  stroke.views = {plan.view, plan.view};
  layer.strokes.push_back(stroke);
}

/// The strokes that begin in one row of cells.
Layer plan_cells(const LayerPlan& plan, const Style& style, const Grid& grid, int row) {
  enum Purpose : std::uint64_t { jitter_x, jitter_y, stroke_choices };
  std::vector<Seed> seeds(grid.columns());
  std::vector<Target> targets(grid.columns());
  for (int column = 0; column < grid.columns(); ++column) {
    const float u = unit_float(cell_hash(plan, style, column, row, jitter_x));
    const float v = unit_float(cell_hash(plan, style, column, row, jitter_y));
    targets[column] = {(static_cast<float>(column) + u) * grid.cell_px, (static_cast<float>(row) + v) * grid.cell_px};
  }
  std::vector<float> errors(plan.canvas.red.width());
  for (int y = grid.top(row); y < grid.top(row + 1); ++y) {
    if (!has_seeds(plan, y)) continue;
    squared_errors(plan.reference, plan.canvas, y, errors.data());
    for (int column = 0; column < grid.columns(); ++column)
      improve_seed(plan, errors.data(), grid.left(column), grid.left(column + 1), y, targets[column], seeds[column]);
  }
  Layer layer;
  const float squared_threshold = style.threshold * style.threshold;
  for (int column = 0; column < grid.columns(); ++column) {
    if (seeds[column].error > squared_threshold)
      add_stroke(plan, style, seeds[column], cell_hash(plan, style, column, row, stroke_choices), layer);
  }
  return layer;
}

}  // namespace

Layer plan_layer(const LayerPlan& plan, const Style& style) {
  const Grid grid(plan, style);
  std::vector<Layer> rows(grid.rows());
  tbb::parallel_for(0, grid.rows(), [&](int row) { rows[row] = plan_cells(plan, style, grid, row); });
  Layer layer;
  layer.radius_px = plan.radius_px;
  for (const Layer& row : rows) append_strokes(row, layer);
  return layer;
}

}  // namespace wheatstone
