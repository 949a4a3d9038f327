#include "wheatstone/app/present_pair.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/drawing/draw.h"

namespace wheatstone {

float comfortable_separation(const Painting& painting, std::optional<float> depth_budget) {
  if (!depth_budget || painting.surfaces.seen.empty()) return 1;
  const DepthEnds ends = depth_ends(painting.surfaces.seen.front().disparity);
  const float depth_px = ends.nearest_px - ends.farthest_px;
  const float budget_px = *depth_budget * static_cast<float>(width_of(painting));
  return depth_px > budget_px ? budget_px / depth_px : 1;
}

StereoPair present_pair(const Painting& painting, const StereoPairView& eyes, float separation,
                        float zero_parallax_px) {
  if (separation >= 1) return set_convergence(eyes, zero_parallax_px);
  const std::array views{ViewPosition(-separation / 2), ViewPosition(separation / 2)};
  std::vector<DrawnView> drawn = draw(prepare(painting), views);
  const StereoPair nearer{std::move(drawn.front().picture), std::move(drawn.back().picture)};
  return set_convergence(nearer, separation * zero_parallax_px);
}

}  // namespace wheatstone
