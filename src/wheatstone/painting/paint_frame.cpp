#include "wheatstone/painting/paint_frame.h"

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

void take_pictures(std::vector<ShownView> shown, PaintedPair& painted) {
  painted.pictures.left = std::move(shown.front().drawn.picture);
  painted.left_bare_share = shown.front().drawn.bare_share;
  if (shown.size() < 2) return;
  painted.pictures.right = std::move(shown.back().drawn.picture);
  painted.right_bare_share = shown.back().drawn.bare_share;
}

}  // namespace

PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory, const Progress& progress, Device device) {
  PaintedFrame result;
  PaintedPair& painted = result.painted;
  {
    const Stopwatch watch(painted.times.planning_s);
    PlannedFrame planned = plan_without_repair(frame, style, options, memory, progress);
    painted.painting = std::move(planned.painting);
    result.counts = planned.counts;
    if (!is_repaired_when_drawn(painted.painting, style)) repair(frame.views, style, painted.painting);
  }
  const Stopwatch watch(painted.times.rasterising_s);
  report(progress, "drawing", 0);
  std::vector<ShownView> shown = shown_views(frame.views);
  draw_shown(painted.painting, style.background, device, shown);
  if (is_repaired_when_drawn(painted.painting, style))
    repair_drawn(shown, frame.views.front().position, style, painted.painting);
  take_pictures(std::move(shown), painted);
  return result;
}

}  // namespace wheatstone
