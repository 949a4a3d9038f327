#include "wheatstone/strokes/layer_plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/random.h"
#include "wheatstone/strokes/dual_stroke_internal.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/jitter_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/seed_internal.h"
#include "wheatstone/strokes/trace_stroke_internal.h"

namespace wheatstone {
namespace {

/// The cells in which strokes of one place begin: a grid of cells f_g·R wide, half that beside depth edges, but not
/// less than the plan wants there; the last row and column may be cut off by the picture's edge.
struct Grid {
  Grid(const LayerPlan& plan, Place place_)
      : place(place_),
        cell_px(place == Place::open ? std::max(plan.style.grid * plan.radius_px, 1.f)
                                     : std::max(plan.style.grid * plan.radius_px / 2, plan.least_edge_cell_px)),
        width(plan.canvas.width),
        height(plan.canvas.height) {}

  int columns() const { return static_cast<int>(std::ceil(static_cast<float>(width) / cell_px)); }
  int rows() const { return static_cast<int>(std::ceil(static_cast<float>(height) / cell_px)); }
  int left(int column) const { return std::min(static_cast<int>(static_cast<float>(column) * cell_px), width); }
  int top(int row) const { return std::min(static_cast<int>(static_cast<float>(row) * cell_px), height); }

  Place place;
  float cell_px;
  int width, height;
};

/// The place where a stroke would begin on a bare cell: the jitter of the grid.
struct Target {
  float x, y;
};

bool may_begin(const LayerPlan& plan, Place place, int x, int y) {
  if (!plan.seeds.empty() && plan.seeds(x, y) == 0) return false;
  if (plan.depth_edges.empty()) return place == Place::open;
  if ((plan.depth_edges(x, y) != 0) != (place == Place::beside_edge)) return false;
  return plan.mixed_colours.empty() || plan.mixed_colours(x, y) == 0;
}

/// How much a stroke is wanted at a pixel; negative: not at all. Among bare pixels, which are all infinitely wrong, the
/// one nearest to the cell's target is wanted most. A pixel right on a depth edge mixes two surfaces' colours: it is
/// taken only where nothing else in the cell is bare.
float desire(const LayerPlan& plan, Place place, float error, int x, int y, const Target& target) {
  const bool on_edge = place == Place::beside_edge && !plan.mixed_colours.empty() && plan.edge_distance(x, y) < 1;
  if (error < bare_error) return on_edge ? -1 : error;
  if (on_edge) return bare_error / 4;
  const float dx = static_cast<float>(x) - target.x, dy = static_cast<float>(y) - target.y;
  return bare_error - std::min(dx * dx + dy * dy, bare_error / 2);
}

/// Misplaced paint is worse than any other paint, and better than a bare pixel.
constexpr float misplaced_error = 3 * 255 * 255;
static_assert(2 * misplaced_error < bare_error / 2);

/// Looks through one row of one cell for a better pixel than the seed's. `errors` is by column of the picture.
void improve_seed(const LayerPlan& plan, Place place, const RowPart& part, const float* errors, const Target& target,
                  Seed& seed) {
  // Nothing in a row is wanted more than a bare pixel right above or below the target.
  const float rows_away = static_cast<float>(part.row) - target.y;
  if (seed.error >= bare_error - rows_away * rows_away && rows_away * rows_away < bare_error / 2) return;
  const ImageView<const std::uint8_t>& mask = plan.misplaced;
  const std::uint8_t* const misplaced = mask.empty() ? nullptr : mask.row(part.row).data();
  for (int x = part.begin; x < part.end; ++x) {
    const bool is_bare = errors[x] >= bare_error, is_misplaced = misplaced != nullptr && misplaced[x] != 0;
    const float own_error = errors[x] + (is_misplaced && !is_bare ? misplaced_error : 0);
    if (own_error <= seed.error) continue;
    const float error = desire(plan, place, own_error, x, part.row, target);
    if (error > seed.error && may_begin(plan, place, x, part.row)) seed = {error, x, part.row};
  }
}

/// The columns in which a mask is set in some rows; an empty mask counts as full.
class MaskOfRows {
 public:
  MaskOfRows(ImageView<const std::uint8_t> mask, int top, int bottom) {
    if (mask.empty()) return;
    any_.resize(static_cast<std::size_t>(mask.width()));
    for (int y = top; y < bottom; ++y) {
      const auto row = mask.row(y);
      for (std::size_t x = 0; x < any_.size(); ++x) any_[x] |= row[x];
    }
  }

  bool has_any(int left, int right) const {
    return any_.empty() ||
           std::any_of(any_.begin() + left, any_.begin() + right, [](auto value) { return value != 0; });
  }

 private:
  std::vector<std::uint8_t> any_;
};

/// A run of neighbouring cells in one row of cells.
struct CellRun {
  int first, end;
};

/// The cells of a row in which strokes may begin at all.
std::vector<CellRun> runs_of_active_cells(const LayerPlan& plan, const Grid& grid, int row) {
  const MaskOfRows seeds(plan.seeds, grid.top(row), grid.top(row + 1));
  const MaskOfRows edges(grid.place == Place::beside_edge ? plan.depth_edges.view() : ImageView<const std::uint8_t>(),
                         grid.top(row), grid.top(row + 1));
  std::vector<CellRun> runs;
  for (int column = 0; column < grid.columns(); ++column) {
    const int left = grid.left(column), right = grid.left(column + 1);
    if (!seeds.has_any(left, right) || !edges.has_any(left, right)) continue;
    if (!runs.empty() && runs.back().end == column) {
      ++runs.back().end;
    } else {
      runs.push_back({column, column + 1});
    }
  }
  return runs;
}

/// The purpose of a random number.
enum Purpose : std::uint64_t { jitter_x, jitter_y, stroke_choices };

std::uint64_t cell_hash(const LayerPlan& plan, Place place, int column, int row, Purpose purpose) {
  return hash_keys({plan.style.seed, static_cast<std::uint64_t>(plan.layer), static_cast<std::uint64_t>(place),
                    static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row), purpose});
}

/// Single wrong disparities would bend the stroke in other views: each becomes the median of itself and its neighbours
/// on the stroke (Bukenberger et al. 2015, sec. 3).
void smooth_disparities(std::span<ControlPoint> points) {
  if (points.empty()) return;
  float before = points[0].disparity;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const float here = points[i].disparity, after = points[i + 1].disparity;
    points[i].disparity = std::max(std::min(before, here), std::min(std::max(before, here), after));
    before = here;
  }
}

/// Keeps the paint of a stroke of the finest layer, which lies over the others, within the outlines of its surface.
/// `points` are the stroke's.
void keep_within_outlines(const LayerPlan& plan, float radius_px, std::span<ControlPoint> points) {
  const StrokeGround ground{plan.view.disparity, plan.depth_threshold_px, plan.beside};
  const auto is_near_edge = [&](const ControlPoint& point) {
    const int column = static_cast<int>(point.x), row = static_cast<int>(point.y);
    return plan.edge_distance.contains(column, row) && !std::isnan(plan.edge_distance(column, row));
  };
  for (ControlPoint& point : points)
    if (is_near_edge(point)) point.disparity = disparity_within_outline(ground, point, radius_px);
  // The stroke stays on its surface.
  const auto follow = [&](std::size_t i, std::size_t neighbour) {
    points[i].disparity = std::max(points[i].disparity, points[neighbour].disparity - plan.depth_threshold_px);
  };
  for (std::size_t i = 1; i < points.size(); ++i) follow(i, i - 1);
  for (std::size_t i = points.size(); i-- > 1;) follow(i - 1, i);
}

void add_stroke(const LayerPlan& plan, const CanvasRows& canvas, Place place, const Seed& seed, std::uint64_t random,
                Layer& layer) {
  const Style& style = plan.style;
  Stroke stroke;
  stroke.first_point = static_cast<std::uint32_t>(layer.points.size());
  stroke.radius_px = stroke_radius(plan, place, seed);
  trace_stroke(plan, canvas, {seed, stroke.radius_px, (random & 1) != 0}, layer.points);
  stroke.point_count = static_cast<std::uint32_t>(layer.points.size()) - stroke.first_point;
  const std::span points = std::span(layer.points).subspan(stroke.first_point);
  settle_disparities(plan, stroke.radius_px, points);
  stroke.opacity = style.opacity;
  const ReferencePicture& reference = *plan.reference;
  stroke.colour =
      jittered({reference.red(seed.x, seed.y), reference.green(seed.x, seed.y), reference.blue(seed.x, seed.y)},
               style.jitter, random);
  stroke.disparity = points.front().disparity;
  stroke.reference_view = plan.view.position;
  stroke.views = all_views;
  layer.strokes.push_back(stroke);
  if (style.dual) make_dual(plan, layer);
}

Target target_of(const LayerPlan& plan, const Grid& grid, int column, int row) {
  const float u = unit_float(cell_hash(plan, grid.place, column, row, jitter_x));
  const float v = unit_float(cell_hash(plan, grid.place, column, row, jitter_y));
  return {(static_cast<float>(column) + u) * grid.cell_px, (static_cast<float>(row) + v) * grid.cell_px};
}

/// The strokes that begin in one row of cells.
Layer plan_cells(const LayerPlan& plan, const CanvasRows& canvas, const Grid& grid, int row) {
  const std::vector<CellRun> runs = runs_of_active_cells(plan, grid, row);
  Layer layer;
  if (runs.empty()) return layer;
  // Cells whose error is too small for a stroke are skipped early.
  const float squared_threshold = plan.style.threshold * plan.style.threshold;
  std::vector<Seed> seeds(grid.columns(), Seed{std::min(squared_threshold, bare_error / 4)});
  std::vector<Target> targets(grid.columns());
  for (const CellRun& run : runs)
    for (int column = run.first; column < run.end; ++column) targets[column] = target_of(plan, grid, column, row);

  std::vector<float> errors(plan.canvas.width);
  for (int y = grid.top(row); y < grid.top(row + 1); ++y) {
    for (const CellRun& run : runs) {
      squared_errors(*plan.reference, canvas, {y, grid.left(run.first), grid.left(run.end)}, errors.data());
      for (int column = run.first; column < run.end; ++column)
        improve_seed(plan, grid.place, {y, grid.left(column), grid.left(column + 1)}, errors.data(), targets[column],
                     seeds[column]);
    }
  }
  for (int column = 0; column < grid.columns(); ++column) {
    if (seeds[column].error > squared_threshold)
      add_stroke(plan, canvas, grid.place, seeds[column], cell_hash(plan, grid.place, column, row, stroke_choices),
                 layer);
  }
  return layer;
}

/// A grid, and the strokes that begin in its rows of cells, as far as these are planned.
struct PlannedGrid {
  PlannedGrid(const LayerPlan& plan, Place place) : grid(plan, place) {}

  /// Plans the rows of cells that begin above a row of pixels.
  void plan_above(int end, const LayerPlan& plan, const CanvasRows& canvas) {
    const int first = static_cast<int>(rows.size());
    int last = first;
    while (last < grid.rows() && grid.top(last) < end) ++last;
    rows.resize(static_cast<std::size_t>(last));
    tbb::parallel_for(first, last, [&](int row) { rows[row] = plan_cells(plan, canvas, grid, row); });
  }

  Grid grid;
  std::vector<Layer> rows;
};

}  // namespace

void settle_disparities(const LayerPlan& plan, float radius_px, std::span<ControlPoint> points) {
  smooth_disparities(points);
  if (!plan.edge_distance.empty()) keep_within_outlines(plan, radius_px, points);
}

float stroke_radius(const LayerPlan& plan, Place place, const Seed& seed) {
  if (place == Place::open) return plan.radius_px;
  const float distance_px = plan.edge_distance(seed.x, seed.y), least_px = std::min(0.75f, plan.radius_px);
  return std::isnan(distance_px) ? plan.radius_px : std::clamp(distance_px, least_px, plan.radius_px);
}

Layer plan_layer(const LayerPlan& plan) {
  if (plan.style.marks == Marks::fitted_strokes) return fit_layer(plan);
  Layer layer;
  layer.radius_px = plan.radius_px;
  std::vector<PlannedGrid> grids{{plan, Place::open}};
  if (!plan.edge_distance.empty()) grids.emplace_back(plan, Place::beside_edge);
  const float cell_px = std::max(grids.front().grid.cell_px, grids.back().grid.cell_px);
  const int margin_px = static_cast<int>(std::ceil(cell_px)) + traced_reach_px(plan);
  for_each_band(plan.canvas, margin_px, [&](const CanvasRows& canvas, int, int end) {
    for (PlannedGrid& planned : grids) planned.plan_above(end, plan, canvas);
  });
  for (const PlannedGrid& planned : grids)
    for (const Layer& row : planned.rows) append_strokes(row, layer);
  return layer;
}

}  // namespace wheatstone
