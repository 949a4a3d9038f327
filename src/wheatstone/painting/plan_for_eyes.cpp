#include "wheatstone/painting/plan_for_eyes.h"

#include <utility>
#include <vector>

#include "wheatstone/painting/repair_internal.h"

namespace wheatstone {
namespace {

/// The scene's views that are shown: the eyes, or the one view there is. Not drawn yet.
std::vector<ShownView> shown_views(std::span<const View> views, Background background) {
  std::vector<ShownView> shown;
  const auto add = [&](const View& view) {
    shown.push_back(
        {view,
         background == Background::photograph ? ImageView<const Rgb8>(view.colour) : ImageView<const Rgb8>(),
         {}});
  };
  for (const ViewPosition eye : {left_eye, right_eye})
    for (const View& view : views)
      if (view.position == eye) add(view);
  if (shown.empty()) add(views.front());
  return shown;
}

PreparedPainting draw_shown(const Painting& painting, Device device, bool deep, std::vector<ShownView>& shown) {
  PreparedPainting prepared = prepare(painting, {.deep = deep}, device);
  std::vector<ViewPosition> positions;
  std::vector<ImageView<const Rgb8>> backgrounds;
  for (const ShownView& eye : shown) {
    positions.push_back(eye.view.position);
    if (!eye.background.empty()) backgrounds.push_back(eye.background);
  }
  std::vector<DrawnView> drawn = draw(prepared, positions, backgrounds);
  for (std::size_t i = 0; i < shown.size(); ++i) shown[i].drawn = std::move(drawn[i]);
  return prepared;
}

}  // namespace

PlannedFrame plan_for_eyes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           PaintingMemory& memory, const Progress& progress, Device device, bool deep) {
  PlannedFrame planned = plan_without_repair(frame, style, options, memory, progress);
  Painting& painting = planned.painting;
  if (!is_repaired_when_drawn(painting, style)) {
    repair(frame.views, style, painting);
    return planned;
  }
  report(progress, "painting", 0);
  std::vector<ShownView> shown = shown_views(frame.views, style.background);
  PreparedPainting prepared = draw_shown(painting, device, deep, shown);
  repair_drawn(shown, frame.views.front().position, style, painting, prepared);
  // A graphics processor, which draws the same but for rounding, has not drawn the repairs.
  if (is_drawn_by_processor(prepared))
    for (ShownView& eye : shown) planned.drawn.push_back(std::move(eye.drawn));
  return planned;
}

}  // namespace wheatstone
