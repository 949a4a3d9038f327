#include "wheatstone/painting/paint_frame.h"

#include <tbb/parallel_for.h>

#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/draw_in_style.h"
#include "wheatstone/error.h"
#include "wheatstone/stopwatch.h"

namespace wheatstone {
namespace {

/// The scene's views that are shown: the eyes, or the one view there is.
std::vector<std::size_t> shown_views(const FilmFrame& frame) {
  std::vector<std::size_t> shown;
  for (const ViewPosition eye : {left_eye, right_eye})
    for (std::size_t i = 0; i < frame.views.size(); ++i)
      if (frame.views[i].position == eye) shown.push_back(i);
  if (shown.empty()) shown.push_back(0);
  return shown;
}

/// Draws the views that are shown; what strokes left bare in any of them gets dots, and all are drawn again.
std::vector<DrawnView> draw_covered(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                                    StrokeMemory& memory, StrokePainting& painting) {
  const std::vector<std::size_t> shown = shown_views(frame);
  std::vector<DrawnView> drawn(shown.size());
  const auto draw_all = [&] {
    tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
      const SceneView& view = frame.views[shown[i]];
      drawn[i] = draw_in_style(view.picture, painting, view.position, style);
    });
  };
  draw_all();
  bool covered = true;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (drawn[i].bare_share == 0) continue;
    insert_strokes(cover_bare(frame, {shown[i], drawn[i].bare}, style, options, memory), style, painting.layers.back());
    covered = false;
  }
  if (!covered) draw_all();
  return drawn;
}

void take_pictures(std::vector<DrawnView> drawn, PaintedPair& painted) {
  painted.pictures.left = std::move(drawn.front().picture);
  painted.left_bare_share = drawn.front().bare_share;
  if (drawn.size() < 2) return;
  painted.pictures.right = std::move(drawn.back().picture);
  painted.right_bare_share = drawn.back().bare_share;
}

PaintedFrame paint_strokes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           StrokeMemory& memory) {
  PaintedFrame result;
  PaintedPair& painted = result.painted;
  {
    const Stopwatch watch(painted.times.planning_s);
    CarriedPainting carried = plan_strokes(frame, style, options, memory);
    painted.painting = std::move(carried.painting);
    result.counts = carried.counts;
  }
  const Stopwatch watch(painted.times.rasterising_s);
  take_pictures(draw_covered(frame, style, options, memory, painted.painting), painted);
  return result;
}

/// Plans the kinds of marks that are not strokes.
void plan_other_marks(const FilmFrame& frame, const Style& style, PaintingMemory& memory, PaintedPair& painted) {
  if (style.marks == Marks::regions) painted.regions = plan_posterised(frame, style, memory.posterised);
  if (style.marks == Marks::tiles) painted.regions = plan_mosaic(frame, style, memory.mosaic);
  if (style.marks == Marks::curves) painted.curves = plan_diffusion(frame, style, memory.diffusion);
}

PaintedFrame paint_other_marks(const FilmFrame& frame, const Style& style, PaintingMemory& memory) {
  PaintedFrame result;
  PaintedPair& painted = result.painted;
  painted.painting.width = frame.views.front().picture.width();
  painted.painting.height = frame.views.front().picture.height();
  {
    const Stopwatch watch(painted.times.planning_s);
    plan_other_marks(frame, style, memory, painted);
  }
  const Stopwatch watch(painted.times.rasterising_s);
  const std::vector<std::size_t> shown = shown_views(frame);
  std::vector<DrawnView> drawn(shown.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    const ViewPosition view = frame.views[shown[i]].position;
    drawn[i] = style.marks == Marks::curves ? draw(painted.curves, view) : draw(painted.regions, view);
  });
  take_pictures(std::move(drawn), painted);
  return result;
}

}  // namespace

PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory) {
  check_style(style);
  return style.marks == Marks::strokes ? paint_strokes(frame, style, options, memory.strokes)
                                       : paint_other_marks(frame, style, memory);
}

}  // namespace wheatstone
