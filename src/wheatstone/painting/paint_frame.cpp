#include "wheatstone/painting/paint_frame.h"

#include <utility>
#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/mend_drawn_internal.h"
#include "wheatstone/painting/mend_spots_internal.h"
#include "wheatstone/painting/plan_unmended_internal.h"
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
  Device device;
};

/// Draws the views that are shown.
std::vector<DrawnView> draw_shown(const FrameTask& task, const std::vector<std::size_t>& shown,
                                  const Painting& painting) {
  report(task.progress, "drawing", 0);
  const PreparedPainting prepared = prepare(painting, {}, task.device);
  const bool over_picture = task.style.background == Background::photograph;
  std::vector<ViewPosition> positions;
  std::vector<ImageView<const Rgb8>> backgrounds;
  for (const std::size_t i : shown) {
    positions.push_back(task.frame.views[i].position);
    if (over_picture) backgrounds.push_back(task.frame.views[i].picture);
  }
  return draw(prepared, positions, backgrounds);
}

void take_pictures(std::vector<DrawnView> drawn, PaintedPair& painted) {
  painted.pictures.left = std::move(drawn.front().picture);
  painted.left_bare_share = drawn.front().bare_share;
  if (drawn.size() < 2) return;
  painted.pictures.right = std::move(drawn.back().picture);
  painted.right_bare_share = drawn.back().bare_share;
}

}  // namespace

PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory, const Progress& progress, Device device) {
  const FrameTask task{frame, style, options, progress, device};
  PaintedFrame result;
  PaintedPair& painted = result.painted;
  bool is_to_mend = false;
  {
    const Stopwatch watch(painted.times.planning_s);
    PlannedFrame planned = plan_unmended(frame, style, options, memory, progress);
    is_to_mend = is_mended_when_drawn(planned.painting, style);
    if (!is_to_mend) mend_spots(frame.views, style, planned.painting);
    painted.painting = std::move(planned.painting);
    result.counts = planned.counts;
  }
  const Stopwatch watch(painted.times.rasterising_s);
  const std::vector<std::size_t> shown = shown_views(frame);
  std::vector<DrawnView> drawn = draw_shown(task, shown, painted.painting);
  if (is_to_mend) mend_drawn(frame.views, shown, style, painted.painting, drawn);
  take_pictures(std::move(drawn), painted);
  return result;
}

}  // namespace wheatstone
