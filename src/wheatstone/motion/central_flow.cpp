#include "wheatstone/motion/central_flow.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheatstone {
namespace {

/// From the central view to the left one, in eye separations to the left.
constexpr float to_left = 0.5f;
constexpr float same_surface_px = 1;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// The disparity of the pixel at a place; the border's beyond it.
float at(const Image<float>& disparity, float x, float y) {
  return disparity(std::clamp(static_cast<int>(x), 0, disparity.width() - 1),
                   std::clamp(static_cast<int>(y), 0, disparity.height() - 1));
}

/// What is unknown in a row takes the flow of the farther of the two known pixels beside it.
void fill_row(const Image<float>& disparity, int y, Flow& flow) {
  const int width = disparity.width();
  const auto x_flow = flow.x.row(y), y_flow = flow.y.row(y);
  for (int begin = 0; begin < width; ++begin) {
    if (!std::isnan(x_flow[begin])) continue;
    int end = begin;
    while (end < width && std::isnan(x_flow[end])) ++end;
    const bool before = begin > 0, after = end < width;
    const int from = !before ? end : !after || disparity(begin - 1, y) <= disparity(end, y) ? begin - 1 : end;
    for (int x = begin; x < end; ++x) {
      x_flow[x] = before || after ? x_flow[from] : 0;
      y_flow[x] = before || after ? y_flow[from] : 0;
    }
    begin = end;
  }
}

Flow one_way(const Flow& left, const MovingMoment& here, const MovingMoment& there) {
  const Image<float>& disparity = here.central_disparity;
  Flow flow{Image<float>(disparity.width(), disparity.height(), unknown),
            Image<float>(disparity.width(), disparity.height(), unknown)};
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const float row = static_cast<float>(y) + 0.5f;
    for (int x = 0; x < disparity.width(); ++x) {
      const float d = disparity(x, y), in_left = static_cast<float>(x) + 0.5f + to_left * d;
      if (!(in_left >= 0 && in_left < static_cast<float>(disparity.width()))) continue;
      if (std::abs(at(here.left_disparity, in_left, row) - d) > same_surface_px) continue;
      const float dx = sample(left.x.view(), in_left, row), dy = sample(left.y.view(), in_left, row);
      if (!std::isfinite(dx + dy)) continue;
      const float then = at(there.left_disparity, in_left + dx, row + dy);
      // Where the point is hidden then, its own disparity is the best guess.
      constexpr float most_change_px = 2;
      const float change = std::abs(then - d) <= most_change_px ? then - d : 0;
      flow.x(x, y) = dx - to_left * change;
      flow.y(x, y) = dy;
    }
    fill_row(disparity, y, flow);
  });
  return flow;
}

}  // namespace

FlowPair central_flow(const FlowPair& left, const MovingMoment& first, const MovingMoment& second) {
  return {one_way(left.forward, first, second), one_way(left.backward, second, first)};
}

}  // namespace wheatstone
