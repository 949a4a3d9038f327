#include "wheatstone/app/present_pair.h"

#include <algorithm>
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

std::vector<ViewPosition> presented_views(float separation) {
  if (separation >= 1) return {};
  return {ViewPosition(-separation / 2), ViewPosition(separation / 2)};
}

StereoPair present_pair(const Painting& painting, const StereoPairView& eyes, float separation,
                        float zero_parallax_px) {
  std::vector<Image<Rgb8>> presented;
  if (separation < 1)
    for (DrawnView& view : draw(prepare(painting), presented_views(separation)))
      presented.push_back(std::move(view.picture));
  return present_pair(presented, eyes, separation, zero_parallax_px);
}

StereoPair present_pair(std::span<const Image<Rgb8>> presented, const StereoPairView& eyes, float separation,
                        float zero_parallax_px) {
  if (presented.empty()) return set_convergence(eyes, zero_parallax_px);
  return set_convergence({presented.front(), presented.back()}, separation * zero_parallax_px);
}

}  // namespace wheatstone
