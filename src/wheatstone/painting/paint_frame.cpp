#include "wheatstone/painting/paint_frame.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "wheatstone/painting/repair_internal.h"
#include "wheatstone/stopwatch.h"

namespace wheatstone {
namespace {

/// The scene's views that are shown: the eyes, or the one view there is. Not drawn yet.
std::vector<ShownView> shown_views(std::span<const View> views) {
  std::vector<ShownView> shown;
  for (const ViewPosition eye : {left_eye, right_eye})
    for (const View& view : views)
      if (view.position == eye) shown.push_back({view, {}});
  if (shown.empty()) shown.push_back({views.front(), {}});
  return shown;
}

void draw_shown(const Painting& painting, Background background, Device device, std::vector<ShownView>& shown) {
  std::vector<ViewPosition> positions;
  std::vector<ImageView<const Rgb8>> backgrounds;
  for (const ShownView& eye : shown) {
    positions.push_back(eye.view.position);
    if (background == Background::photograph) backgrounds.push_back(eye.view.colour);
  }
  std::vector<DrawnView> drawn = draw(prepare(painting, {}, device), positions, backgrounds);
  for (std::size_t i = 0; i < shown.size(); ++i) shown[i].drawn = std::move(drawn[i]);
}

Presented presented(std::vector<ShownView> shown) {
  Presented presented;
  for (ShownView& eye : shown) {
    presented.views.push_back(std::move(eye.drawn.picture));
    presented.bare_shares.push_back(eye.drawn.bare_share);
    presented.worst_bare_share = std::max(presented.worst_bare_share, eye.drawn.bare_share);
  }
  return presented;
}

}  // namespace

PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory, const Progress& progress, Device device) {
  PaintedFrame result;
  {
    const Stopwatch watch(result.times.planning_s);
    PlannedFrame planned = plan_without_repair(frame, style, options, memory, progress);
    result.painting = std::move(planned.painting);
    result.counts = planned.counts;
    if (!is_repaired_when_drawn(result.painting, style)) repair(frame.views, style, result.painting);
  }
  const Stopwatch watch(result.times.rasterising_s);
  report(progress, "drawing", 0);
  std::vector<ShownView> shown = shown_views(frame.views);
  draw_shown(result.painting, style.background, device, shown);
  if (is_repaired_when_drawn(result.painting, style))
    repair_drawn(shown, frame.views.front().position, style, result.painting);
  result.shown = presented(std::move(shown));
  return result;
}

}  // namespace wheatstone
