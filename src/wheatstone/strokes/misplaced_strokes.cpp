#include "wheatstone/strokes/misplaced_strokes_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "wheatstone/marks/residual.h"
#include "wheatstone/strokes/carry_strokes_internal.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {

void drop_misplaced(ViewPosition home, std::span<const View> views, float depth_threshold_px, TrackedLayer& tracked) {
  std::vector<NearColours> near;
  for (const View& view : views) near.emplace_back(view.colour);
  const auto shows_unlike = [&](const Stroke& stroke, const ControlPoint& point, std::size_t number) {
    const View& view = views[number];
    if (view.continued) return false;
    const int x = static_cast<int>(std::floor(view.frame.column(x_in_view(point, home, view.position))));
    const int y = static_cast<int>(std::floor(point.y));
    return view.colour.contains(x, y) && is_visible(point, home, view, depth_threshold_px) &&
           !near[number].has(stroke.colour, x, y);
  };
  std::vector<std::uint8_t> is_misplaced(tracked.tracks.size());
  tbb::parallel_for(std::size_t{0}, is_misplaced.size(), [&](std::size_t i) {
    if (tracked.tracks[i].ends == 0) return;
    const Stroke& stroke = tracked.layer.strokes[i];
    is_misplaced[i] = std::ranges::any_of(tracked.layer.points_of(stroke), [&](const ControlPoint& point) {
      for (std::size_t number = 0; number < views.size(); ++number)
        if (shows_unlike(stroke, point, number)) return true;
      return false;
    });
  });
  keep_if(tracked, [&](std::size_t i) { return is_misplaced[i] == 0; });
}

}  // namespace wheatstone
