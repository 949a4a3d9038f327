#include "wheatstone/strokes/refit_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/marks/brush.h"
#include "wheatstone/strokes/begun_canvas_internal.h"

namespace wheatstone {
namespace {

/// The depth edges that a layer's weights depend on.
ImageView<const std::uint8_t> outlines(const LayerPlan& plan) {
  return weighs_outlines(plan) ? plan.depth_edges.view() : ImageView<const std::uint8_t>();
}

bool may_compare(const LayerPlan& plan, std::size_t blocks, const LayerFit& before) {
  return before.blocks.size() == blocks && before.style == plan.style && before.radius_px == plan.radius_px &&
         before.least_gain == plan.least_gain && before.depth_threshold_px == plan.depth_threshold_px &&
         same_size(before.disparity, plan.view.disparity) && same_size(before.seeds, plan.seeds) &&
         same_size(before.detail, plan.view.detail) && same_size(before.outlines, outlines(plan));
}

LayerFit nothing_known(const LayerPlan& plan, std::size_t blocks) {
  LayerFit fit{plan.style, plan.radius_px, plan.least_gain, plan.depth_threshold_px};
  fit.seeds = Image<std::uint8_t>(plan.seeds.width(), plan.seeds.height());
  fit.disparity = Image<float>(plan.canvas.width, plan.canvas.height);
  for (PaintedPicture& canvas : fit.canvases) canvas = PaintedPicture(plan.canvas.width, plan.canvas.height);
  fit.canvas = PaintedPicture(plan.canvas.width, plan.canvas.height);
  fit.blocks.resize(blocks);
  return fit;
}

template <class Pixel>
bool are_equal(std::span<const Pixel> a, std::span<const Pixel> b) {
  return std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// Marks the pixels in which two rows differ.
template <class Pixel>
void mark_differences(std::span<const Pixel> before, std::span<const Pixel> now, std::span<std::uint8_t> differs) {
  if (are_equal(before, now)) return;
  for (std::size_t x = 0; x < before.size(); ++x)
    if (!(before[x] == now[x])) differs[x] = 255;
}

/// Marks the pixels of a row near which two references differ, as far as differences are weighed by them.
void mark_weighed_differences(const ReferencePicture& before, const ReferencePicture& now, int y,
                              std::span<std::uint8_t> differs) {
  thread_local std::vector<std::uint8_t> changed;
  changed.assign(differs.size(), 0);
  const int end = std::min(y + weight_reach_px + 1, now.red.height());
  for (int row = std::max(y - weight_reach_px, 0); row < end; ++row) {
    mark_differences(before.red.row(row), now.red.row(row), std::span(changed));
    mark_differences(before.green.row(row), now.green.row(row), std::span(changed));
    mark_differences(before.blue.row(row), now.blue.row(row), std::span(changed));
  }
  constexpr auto reach = std::size_t{weight_reach_px};
  for (std::size_t x = 0; x < changed.size(); ++x)
    if (changed[x] != 0)
      std::fill(&differs[x - std::min(x, reach)], &differs[std::min(x + reach, changed.size() - 1)] + 1,
                std::uint8_t{255});
}

/// Marks the pixels in which two rows differ, and makes the first one equal the second.
template <class Pixel>
void take_over(std::span<Pixel> before, std::span<const Pixel> now, std::span<std::uint8_t> differs) {
  if (are_equal<Pixel>(before, now)) return;
  mark_differences<Pixel>(before, now, differs);
  std::ranges::copy(now, before.begin());
}

/// The same for whole pictures, whose sizes may differ.
void take_over(Image<std::uint8_t>& before, ImageView<const std::uint8_t> now, Image<std::uint8_t>& differs) {
  if (!same_size(before, now)) before = Image<std::uint8_t>(now.width(), now.height());
  tbb::parallel_for(0, now.height(),
                    [&](int y) { take_over<std::uint8_t>(before.row(y), now.row(y), differs.row(y)); });
}

bool has_any(std::span<const std::uint8_t> marks) { return std::memchr(marks.data(), 255, marks.size()) != nullptr; }

template <class Pixel>
bool are_equal(ImageView<const Pixel> a, ImageView<const Pixel> b) {
  if (!same_size(a, b)) return false;
  for (int y = 0; y < a.height(); ++y)
    if (!are_equal(a.row(y), b.row(y))) return false;
  return true;
}

}  // namespace

bool ViewFit::holds(const View& now, const Style& style_now, const ViewsBeside& beside_now,
                    int reference_width_now) const {
  return style == style_now && reference_width == reference_width_now && beside == beside_now &&
         view.position == now.position && view.frame == now.frame && view.continued == now.continued &&
         are_equal<std::uint8_t>(view.detail, now.detail) && are_equal<std::uint8_t>(view.wanted, now.wanted) &&
         are_equal<float>(view.disparity, now.disparity) && are_equal<Rgb8>(view.colour, now.colour);
}

bool LayerFit::is_made_from(ImageView<const Rgb8> now, float radius_now_px, const Style& style_now) const {
  return reference != nullptr && radius_px == radius_now_px && style == style_now && are_equal<Rgb8>(colour, now);
}

Refit::Refit(const LayerPlan& plan, std::size_t blocks, LayerFit& before)
    : before_(before), differs_(plan.canvas.width, plan.canvas.height) {
  if (!may_compare(plan, blocks, before)) {
    before_ = nothing_known(plan, blocks);
    std::ranges::fill(differs_.pixels(), std::uint8_t{255});
  } else if (before_.reference != plan.reference) {
    plan.reference->orientation.visit_differences(before_.reference->orientation,
                                                  [this](int left, int top, int right, int bottom) {
                                                    mark({left, top, right, bottom});
                                                  });
  }
  take_over(before_.detail, plan.view.detail, differs_);
  take_over(before_.outlines, outlines(plan), differs_);
  tbb::parallel_for(0, differs_.height(), [&](int y) { compare_row(plan, y); });
  if (before_.reference == plan.reference) return;
  before_.colour = copy_of<Rgb8>(plan.view.colour);
  before_.reference = plan.reference;
}

void Refit::compare_row(const LayerPlan& plan, int y) {
  const auto differs = differs_.row(y);
  if (before_.reference != nullptr && before_.reference != plan.reference)
    mark_weighed_differences(*before_.reference, *plan.reference, y, differs);
  take_over(before_.disparity.row(y), std::span<const float>(plan.view.disparity.row(y)), differs);
  if (!plan.seeds.empty()) take_over(before_.seeds.row(y), plan.seeds.row(y), differs);
  const auto begun = before_.canvases.front().row(y);
  const DifferingRows& rows = before_.drawing.differs;
  if (rows.empty() || rows[static_cast<std::size_t>(y)] != 0) {
    thread_local std::vector<PaintedPixel> painted;
    painted.resize(differs.size());
    take_painted_row(plan.canvas.canvas, y, painted);
    take_over(begun, std::span<const PaintedPixel>(painted), differs);
  }
  if (has_any(differs)) std::ranges::copy(begun, before_.canvas.row(y).begin());
}

bool Refit::differs(const PixelArea& area) const {
  const int left = std::max(area.left, 0), top = std::max(area.top, 0);
  const int right = std::min(area.right, differs_.width()), bottom = std::min(area.bottom, differs_.height());
  for (int y = top; y < bottom && left < right; ++y)
    if (std::memchr(&differs_(left, y), 255, static_cast<std::size_t>(right - left)) != nullptr) return true;
  return false;
}

void Refit::mark(const PixelArea& area) {
  const int left = std::max(area.left, 0), right = std::min(area.right, differs_.width());
  for (int y = std::max(area.top, 0); y < std::min(area.bottom, differs_.height()) && left < right; ++y)
    std::fill_n(&differs_(left, y), right - left, std::uint8_t{255});
}

void Refit::restore(int wave, const PixelArea& area, PaintedPicture& canvas) const {
  const PaintedPicture& begun = before_.canvases[static_cast<std::size_t>(wave)];
  for (int y = area.top; y < area.bottom; ++y)
    for (int x = area.left; x < area.right; ++x)
      if (differs_(x, y) == 0) canvas(x, y) = begun(x, y);
}

void Refit::end_wave(int wave) {
  if (wave + 1 == fit_waves) return;
  PaintedPicture& begun = before_.canvases[static_cast<std::size_t>(wave) + 1];
  tbb::parallel_for(0, begun.height(), [&](int y) {
    const auto differs = differs_.row(y);
    if (!has_any(differs)) return;
    const auto from = before_.canvas.row(y);
    const auto to = begun.row(y);
    for (std::size_t x = 0; x < to.size(); ++x)
      if (differs[x] != 0) to[x] = from[x];
  });
}

void Refit::mark_rows() {
  DifferingRows& rows = before_.drawing.differs;
  rows.resize(static_cast<std::size_t>(differs_.height()));
  for (int y = 0; y < differs_.height(); ++y)
    if (has_any(differs_.row(y))) rows[static_cast<std::size_t>(y)] = 1;
}

namespace {

void mark_stroke(const Layer& layer, const Stroke& stroke, DifferingRows& differs) {
  const float reach = BrushProfile(stroke.radius_px).reach_px + 1;
  const auto [top, bottom] = std::ranges::minmax(layer.points_of(stroke), {}, &ControlPoint::y);
  const int height = static_cast<int>(differs.size());
  const int first = std::clamp(static_cast<int>(std::floor(top.y - reach)), 0, height);
  const int end = std::clamp(static_cast<int>(std::floor(bottom.y + reach)) + 1, first, height);
  std::fill(differs.begin() + first, differs.begin() + end, std::uint8_t{1});
}

bool are_equal(const Layer& before, Stroke stroke, const Layer& now, const Stroke& other) {
  const std::span<const ControlPoint> points = before.points_of(stroke);
  stroke.first_point = other.first_point;
  return stroke == other && std::ranges::equal(points, now.points_of(other));
}

/// Marks the rows of strokes that only one of two layers has.
void mark_changes(const Layer& before, const Layer& now, DifferingRows& differs) {
  auto was = before.strokes.begin();
  auto is = now.strokes.begin();
  while (was != before.strokes.end() || is != now.strokes.end()) {
    const bool gone = is == now.strokes.end() || (was != before.strokes.end() && was->number < is->number);
    const bool is_new = !gone && (was == before.strokes.end() || is->number < was->number);
    if (!is_new && !gone && are_equal(before, *was, now, *is)) {
      ++was, ++is;
      continue;
    }
    if (!is_new) mark_stroke(before, *was++, differs);
    if (!gone) mark_stroke(now, *is++, differs);
  }
}

/// The bands of rows (drawing/rasterise.h) in which a row is marked.
std::vector<std::uint8_t> bands_of(const DifferingRows& differs) {
  std::vector<std::uint8_t> bands(static_cast<std::size_t>(band_count(static_cast<int>(differs.size()))));
  for (std::size_t y = 0; y < differs.size(); ++y) bands[y / band_rows] |= differs[y];
  return bands;
}

constexpr std::array<Image<float> Canvas::*, 4> planes{&Canvas::red, &Canvas::green, &Canvas::blue, &Canvas::coverage};

/// A band of a canvas.
struct CanvasBand {
  int first, end;
  std::array<std::vector<float>, planes.size()> rows;
};

/// Copies a band of the canvas on which a layer begins to the one with its strokes, and returns what was there.
CanvasBand begin_band(const Canvas& begun, int band, Canvas& painted) {
  CanvasBand before{band * band_rows, std::min((band + 1) * band_rows, painted.height), {}};
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    for (int y = before.first; y < before.end; ++y) {
      const auto row = (painted.*planes[plane]).row(y);
      before.rows[plane].insert(before.rows[plane].end(), row.begin(), row.end());
      std::ranges::copy((begun.*planes[plane]).row(y), row.begin());
    }
  }
  return before;
}

/// Marks the rows of a band that have changed, and only these.
void compare_band(const CanvasBand& before, const Canvas& painted, DifferingRows& differs) {
  const auto width = static_cast<std::size_t>(painted.width);
  for (int y = before.first; y < before.end; ++y) {
    bool changed = false;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
      const std::span<const float> row = (painted.*planes[plane]).row(y);
      const auto first = static_cast<std::size_t>(y - before.first) * row.size();
      changed = changed || !are_equal<float>(std::span(before.rows[plane]).subspan(first, width), row.first(width));
    }
    differs[static_cast<std::size_t>(y)] = changed ? 1 : 0;
  }
}

}  // namespace

Canvas enlarge_again(const BegunCanvas& begun, LayerDrawing& drawing) {
  const int width = begun.width, height = begun.height;
  std::optional<Canvas> kept = std::exchange(drawing.begun, {});
  const auto rows = static_cast<std::size_t>(height);
  if (!kept || kept->width != width || kept->height != height || drawing.differs.size() != rows) {
    drawing.differs.assign(rows, 1);
    return enlarged_canvas(begun);
  }
  const std::vector<std::uint8_t> bands = bands_of(drawing.differs);
  tbb::parallel_for(0, static_cast<int>(bands.size()), [&](int band) {
    if (bands[static_cast<std::size_t>(band)] != 0)
      enlarge_rows(begun, band * band_rows, std::min((band + 1) * band_rows, height), *kept);
  });
  return std::move(*kept);
}

void draw_again(const Layer& strokes, const Canvas& begun, ViewPosition view, const Hiding& hiding, const Brush& brush,
                LayerDrawing& drawing) {
  DifferingRows& differs = drawing.differs;
  if (!drawing.painted) {
    drawing.painted = begun;
    std::ranges::fill(differs, std::uint8_t{1});
    rasterise(strokes, view, hiding, *drawing.painted, brush);
  } else {
    mark_changes(drawing.strokes, strokes, differs);
    const std::vector<std::uint8_t> bands = bands_of(differs);
    std::vector<CanvasBand> before(bands.size());
    const auto for_marked = [&](auto work) {
      tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
        if (bands[band] != 0) work(band);
      });
    };
    for_marked([&](std::size_t band) { before[band] = begin_band(begun, static_cast<int>(band), *drawing.painted); });
    rasterise(strokes, view, hiding, *drawing.painted, brush, bands);
    for_marked([&](std::size_t band) { compare_band(before[band], *drawing.painted, differs); });
  }
  drawing.strokes = strokes;
}

void pass_on(const DifferingRows& differs, int factor, int height, DifferingRows& next) {
  if (next.size() != static_cast<std::size_t>(height)) {
    next.assign(static_cast<std::size_t>(height), 1);
    return;
  }
  for (int row = 0, rows = static_cast<int>(differs.size()); row < rows; ++row) {
    if (differs[static_cast<std::size_t>(row)] == 0) continue;
    // A row is interpolated from the nearest two, and rows that make no whole smaller one repeat the last one.
    const int reach = factor > 1 ? factor : 0;
    const int first = std::max(row * factor - reach, 0);
    const int end = row + 1 == rows ? height : std::min((row + 1) * factor + reach, height);
    std::fill(next.begin() + first, next.begin() + end, std::uint8_t{1});
  }
}

}  // namespace wheatstone
