#include "wheatstone/painting/plan_for_eyes.h"

#include <utility>
#include <vector>

#include "wheatstone/painting/repair_internal.h"

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

}  // namespace

PlannedFrame plan_for_eyes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           PaintingMemory& memory, const Progress& progress, Device device) {
  PlannedFrame planned = plan_without_repair(frame, style, options, memory, progress);
  Painting& painting = planned.painting;
  if (!is_repaired_when_drawn(painting, style)) {
    repair(frame.views, style, painting);
    return planned;
  }
  report(progress, "painting", 0);
  std::vector<ShownView> shown = shown_views(frame.views);
  draw_shown(painting, style.background, device, shown);
  repair_drawn(shown, frame.views.front().position, style, painting);
  return planned;
}

}  // namespace wheatstone
