#include "wheatstone/painting/paint_frame.h"

#include <tbb/parallel_for.h>

#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/draw_in_style.h"
#include "wheatstone/drawing/relief.h"
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

/// A frame, and how it is to be painted.
struct FrameTask {
  const FilmFrame& frame;
  const Style& style;
  const CarryOptions& options;
  const Progress& progress;
};

/// Draws the views that are shown; what strokes left bare in any of them gets dots, and all are drawn again.
std::vector<DrawnView> draw_covered(const FrameTask& task, StrokeMemory& memory, StrokePainting& painting) {
  const auto& [frame, style, options, progress] = task;
  const std::vector<std::size_t> shown = shown_views(frame);
  std::vector<DrawnView> drawn(shown.size());
  const auto draw_all = [&] {
    report(task.progress, "drawing", 0);
    tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
      const SceneView& view = task.frame.views[shown[i]];
      drawn[i] = draw_in_style(view.picture, painting, view.position, task.style);
    });
  };
  draw_all();
  bool covered = true;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (drawn[i].bare_share == 0) continue;
    report(progress, "covering", static_cast<double>(i) / static_cast<double>(shown.size()));
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

PaintedFrame paint_strokes(const FrameTask& task, StrokeMemory& memory) {
  PaintedFrame result;
  PaintedPair& painted = result.painted;
  {
    const Stopwatch watch(painted.times.planning_s);
    CarriedPainting carried = plan_strokes(task.frame, task.style, task.options, memory, task.progress);
    painted.painting.strokes = std::move(carried.painting);
    result.counts = carried.counts;
  }
  const Stopwatch watch(painted.times.rasterising_s);
  take_pictures(draw_covered(task, memory, painted.painting.strokes), painted);
  return result;
}

/// Plans the kinds of marks that are not strokes.
void plan_other_marks(const FrameTask& task, PaintingMemory& memory, Painting& painting) {
  const auto& [frame, style, options, progress] = task;
  report(progress, "painting", 0);
  if (style.marks == Marks::regions) painting.regions = plan_posterised(frame, style, memory.posterised);
  if (style.marks == Marks::tiles) painting.regions = plan_mosaic(frame, style, memory.mosaic);
  if (style.marks == Marks::curves) painting.curves = plan_diffusion(frame, style, memory.diffusion);
}

PaintedFrame paint_other_marks(const FrameTask& task, PaintingMemory& memory) {
  const FilmFrame& frame = task.frame;
  PaintedFrame result;
  PaintedPair& painted = result.painted;
  painted.painting.strokes.width = frame.views.front().picture.width();
  painted.painting.strokes.height = frame.views.front().picture.height();
  {
    const Stopwatch watch(painted.times.planning_s);
    plan_other_marks(task, memory, painted.painting);
  }
  report(task.progress, "drawing", 0);
  const Stopwatch watch(painted.times.rasterising_s);
  const std::vector<std::size_t> shown = shown_views(frame);
  std::vector<DrawnView> drawn(shown.size());
  tbb::parallel_for(std::size_t{0}, shown.size(),
                    [&](std::size_t i) { drawn[i] = draw(painted.painting, frame.views[shown[i]].position); });
  take_pictures(std::move(drawn), painted);
  return result;
}

}  // namespace

PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory, const Progress& progress) {
  check_style(style);
  const FrameTask task{frame, style, options, progress};
  PaintedFrame result =
      style.marks == Marks::strokes ? paint_strokes(task, memory.strokes) : paint_other_marks(task, memory);
  result.painted.painting.relief = relief_for(style, result.painted.painting.strokes.width);
  return result;
}

}  // namespace wheatstone
