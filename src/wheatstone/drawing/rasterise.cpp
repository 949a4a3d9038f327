#include "wheatstone/drawing/rasterise.h"

#include <tbb/concurrent_queue.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "wheatstone/drawing/rasterise_internal.h"

namespace wheatstone {

std::vector<std::vector<std::uint32_t>> strokes_by_band(const FlatLayer& layer, int height) {
  std::vector<std::vector<std::uint32_t>> bands(band_count(height));
  const int last_band = static_cast<int>(bands.size()) - 1;
  for (std::uint32_t i = 0; i < layer.strokes.size(); ++i) {
    const FlatStroke& stroke = layer.strokes[i];
    const float reach = BrushProfile(stroke.radius_px).reach_px;
    const float top = stroke.top - reach, bottom = stroke.bottom + reach;
    if (bottom < 0 || top >= static_cast<float>(height)) continue;
    const int first = std::max(static_cast<int>(top), 0) / band_rows;
    const int last = std::min(static_cast<int>(bottom) / band_rows, last_band);
    for (int band = first; band <= last; ++band) bands[band].push_back(i);
  }
  return bands;
}

FrontToBackAccumulator::FrontToBackAccumulator(int row_count, int canvas_width, bool keeps_cover)
    : width_(canvas_width),
      rows_(row_count),
      blocks_(static_cast<std::size_t>(row_count) * static_cast<std::size_t>((canvas_width + block_px - 1) / block_px)),
      covers_(keeps_cover ? blocks_.size() : 0),
      open_columns_(blocks_.size() + Canvas::widest_vector),
      open_rows_(static_cast<std::size_t>((canvas_width + block_px - 1) / block_px)),
      touched_rows_(open_rows_.size(), ~std::uint32_t{0} >> (32 - rows_)) {
  clear();
}

void FrontToBackAccumulator::clear() {
  for (int number = 0; number < block_count(); ++number) {
    // Nothing is to be drawn in the columns after the last one.
    const int columns = std::min(width_ - number * block_px, block_px);
    std::uint32_t& touched = touched_rows_[static_cast<std::size_t>(number)];
    for (; touched != 0; touched &= touched - 1) {
      const int row = std::countr_zero(touched);
      Block& cleared = block(row, number);
      for (float* const plane : {cleared.red, cleared.green, cleared.blue, cleared.light})
        std::fill_n(plane, block_px, 0.f);
      std::fill_n(cleared.light, columns, 1.f);
      open_columns_of(number)[row] = static_cast<std::uint16_t>((std::uint32_t{1} << columns) - 1);
      if (Cover* const most = cover(row, number)) most->fill(0);
    }
    open_rows_[static_cast<std::size_t>(number)] = ~std::uint32_t{0} >> (32 - rows_);
  }
}

bool FrontToBackAccumulator::open_only(int row, std::span<const std::uint8_t> mask) {
  bool any = false;
  for (int number = 0; number < block_count(); ++number) {
    const auto columns = mask.subspan(static_cast<std::size_t>(number) * block_px,
                                      static_cast<std::size_t>(std::min(width_ - number * block_px, block_px)));
    std::uint8_t any_column = 0;
    for (const std::uint8_t value : columns) any_column |= value;
    std::uint32_t open = 0;
    if (any_column != 0) {
      float* const through = block(row, number).light;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        open |= std::uint32_t{columns[i] != 0} << i;
        through[i] = columns[i] != 0 ? 1.f : 0.f;
      }
      any = true;
    }
    open_columns_of(number)[row] = static_cast<std::uint16_t>(open);
    const std::uint32_t own = std::uint32_t{1} << row;
    if (open != 0)
      touched_rows_[static_cast<std::size_t>(number)] |= own;
    else
      open_rows_[static_cast<std::size_t>(number)] &= ~own;
  }
  return any;
}

void FrontToBackAccumulator::clamp(int row, int& begin, int& end) const {
  int first = begin / block_px, last = (end - 1) / block_px;
  while (first <= last && open_columns(row, first) == 0) ++first;
  while (last > first && open_columns(row, last) == 0) --last;
  begin = std::max(begin, first * block_px);
  end = std::min(end, (last + 1) * block_px);
}

std::uint32_t Stamps::add_lines(std::size_t count) {
  const std::size_t first = line_count;
  line_count += count;
  const std::size_t padded = line_count + Canvas::widest_vector;
  first_values.resize(padded);
  begins.resize(padded);
  ends.resize(padded);
  return static_cast<std::uint32_t>(first);
}

void Chain::resize(std::size_t count) {
  const std::size_t padded = count + Canvas::widest_vector;
  if (x.size() >= padded) return;
  for (std::vector<float>* values :
       {&x, &y, &dx, &dy, &disparity, &disparity_step, &along_x, &along_y, &course_x, &course_y, &length, &begins_px,
        &along_slope, &along_middle, &along_half, &across_slope, &across_half})
    values->resize(padded);
  for (std::vector<int>* rows : {&first_row, &end_row}) rows->resize(padded);
  for (std::vector<int>* columns : {&begin, &end}) columns->resize(padded * band_rows);
}

DistanceBand::DistanceBand(int top_, int canvas_width, int canvas_height)
    : top(top_),
      row_count(std::min(band_rows, canvas_height - top)),
      stride(canvas_width + 2 * Canvas::widest_vector),
      squared(static_cast<std::size_t>(row_count) * stride),
      begin(row_count + Canvas::widest_vector),
      end(row_count + Canvas::widest_vector) {}

namespace {

/// Whether light comes through anywhere in the columns and rows of a band that a stroke may touch.
bool may_be_seen(const SeenLayer& seen, const FlatStroke& stroke, const DistanceBand& band,
                 const FrontToBackAccumulator& drawn) {
  const float reach = BrushProfile(stroke.radius_px).reach_px + 1;
  const auto [least, most] =
      std::minmax({seen.shift * stroke.farthest_disparity, seen.shift * stroke.nearest_disparity});
  const int begin = std::max(static_cast<int>(stroke.left - most - reach), 0);
  const int end = std::min(static_cast<int>(stroke.right - least + reach) + 1, drawn.width());
  if (begin >= end) return false;
  const auto rows_below = [&](float y) {
    const int row = std::clamp(static_cast<int>(y) - band.top, 0, band.row_count);
    return (std::uint64_t{1} << row) - 1;
  };
  const std::uint64_t rows = rows_below(stroke.bottom + reach + 1) & ~rows_below(stroke.top - reach);
  return (drawn.open_rows(begin, end) & rows) != 0;
}

/// Draws a layer band by band, on a canvas of some size. Bands for which `is_wanted(band, has_strokes)` or
/// `begin(top, drawn)` is false are left out; `finish(top, drawn)` takes what was drawn.
template <class IsWanted, class Begin, class Finish>
void draw_bands(const Layer& layer, const Brush& brush, ViewPosition view, const Hiding& hiding, int width, int height,
                IsWanted is_wanted, Begin begin, Finish finish) {
  const FlatLayer flat = flatten(layer);
  const SeenLayer seen(flat, view);
  const auto bands = strokes_by_band(flat, height);
  tbb::concurrent_queue<FrontToBackAccumulator> kept;  // reused, because fresh memory is slow
  tbb::parallel_for(0, static_cast<int>(bands.size()), [&](int i) {
    if (!is_wanted(i, !bands[i].empty())) return;
    const int top = i * band_rows, row_count = std::min(band_rows, height - top);
    FrontToBackAccumulator drawn;
    if (kept.try_pop(drawn) && drawn.rows() == row_count) {
      drawn.clear();
    } else {
      drawn = FrontToBackAccumulator(row_count, width, true);
    }
    if (!begin(top, drawn)) {
      kept.push(std::move(drawn));
      return;
    }
    DistanceBand band(top, width, height);
    const BandHiding hides(hiding, band, width);
    for (std::size_t nearer = bands[i].size(); nearer-- > 0;) {
      if (nearer >= FlatLayer::strokes_ahead) flat.ask_for_stroke(bands[i][nearer - FlatLayer::strokes_ahead]);
      if (nearer >= FlatLayer::vertices_ahead) flat.ask_for_vertices(bands[i][nearer - FlatLayer::vertices_ahead]);
      const FlatStroke& stroke = flat.strokes[bands[i][nearer]];
      if (stroke.views.contains(view) && may_be_seen(seen, stroke, band, drawn))
        draw_stroke_under({seen, stroke, hides.own, brush}, band, drawn);
    }
    finish(top, drawn);
    kept.push(std::move(drawn));
  });
}

}  // namespace

void rasterise(const Layer& layer, ViewPosition view, const Hiding& hiding, Canvas& canvas, const Brush& brush,
               std::span<const std::uint8_t> wanted) {
  draw_bands(
      layer, brush, view, hiding, canvas.width, canvas.height,
      [&](int band, bool has_strokes) {
        return has_strokes && (wanted.empty() || wanted[static_cast<std::size_t>(band)] != 0);
      },
      [](int, const FrontToBackAccumulator&) { return true; },
      [&](int top, FrontToBackAccumulator& drawn) { lay_over(drawn, top, canvas); });
}

void rasterise_bands(const Layer& layer, ViewPosition view, const Hiding& hiding, int width, int height,
                     const Brush& brush, const CanvasBandWork& begin, const CanvasBandWork& finish) {
  draw_bands(
      layer, brush, view, hiding, width, height, [](int, bool) { return true; },
      [](int, const FrontToBackAccumulator&) { return true; },
      [&](int top, FrontToBackAccumulator& drawn) {
        Canvas canvas(width, drawn.rows(), {});
        begin(top, canvas);
        lay_over(drawn, 0, canvas);
        finish(top, canvas);
      });
}

Image<std::uint8_t> left_bare(const Layer& layer, ViewPosition view, const Hiding& hiding, Image<std::uint8_t> bare,
                              const Brush& brush) {
  constexpr float least_cover = 0.5f;  // of what is not bare
  const auto begin = [&](int top, FrontToBackAccumulator& drawn) {
    bool any = false;
    for (int row = 0; row < drawn.rows(); ++row) any = drawn.open_only(row, bare.row(top + row)) || any;
    return any;
  };
  const auto finish = [&](int top, FrontToBackAccumulator& drawn) {
    for (int row = 0; row < drawn.rows(); ++row) {
      const auto marks = bare.row(top + row);
      for (int x = 0; x < drawn.width(); ++x) {
        if (marks[x] == 0) continue;
        constexpr int block_px = FrontToBackAccumulator::block_px;
        const float most = (*drawn.cover(row, x / block_px))[static_cast<std::size_t>(x % block_px)];
        if (most >= least_cover || drawn.light(row, x) <= FrontToBackAccumulator::dark) marks[x] = 0;
      }
    }
  };
  draw_bands(
      layer, brush, view, hiding, bare.width(), bare.height(), [](int, bool has_strokes) { return has_strokes; }, begin,
      finish);
  return bare;
}

}  // namespace wheatstone
