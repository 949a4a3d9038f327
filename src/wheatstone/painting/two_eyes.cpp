#include "wheatstone/painting/two_eyes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/percentile.h"

namespace wheatstone {

bool are_moved(const TwoEyes& eyes) { return eyes.separation < 1 || eyes.zero_parallax_px != 0; }

Presentation for_two_eyes(const TwoEyes& eyes) {
  return {.views = {ViewPosition(-eyes.separation / 2), ViewPosition(eyes.separation / 2)},
          .placement = eyes.placement};
}

Presentation for_own_and_nearer_eyes(float separation) {
  Presentation presentation = for_two_eyes();
  if (separation >= 1) return presentation;
  const std::vector<ViewPosition> nearer = for_two_eyes({.separation = separation}).views;
  presentation.views.insert(presentation.views.end(), nearer.begin(), nearer.end());
  return presentation;
}

float comfortable_separation(const Painting& painting, std::optional<float> depth_budget) {
  if (!depth_budget || painting.surfaces.seen.empty()) return 1;
  const DepthEnds ends = depth_ends(painting.surfaces.seen.front().disparity);
  const float depth_px = ends.nearest_px - ends.farthest_px;
  const float budget_px = *depth_budget * static_cast<float>(width_of(painting));
  return depth_px > budget_px ? budget_px / depth_px : 1;
}

TwoEyes comfortable_eyes(PictureSize frame, const DepthEnds& ends, float depth_budget,
                         std::optional<float> zero_parallax_px) {
  const auto width = static_cast<float>(frame.width);
  const float budget_px = depth_budget * width, before_px = budget_px / 3, behind_px = budget_px - before_px;
  const float depth_px = std::max(ends.nearest_px - ends.farthest_px, 1e-3f);
  TwoEyes eyes;
  float scale = 1;
  // Shifted pictures are cropped, and enlarged to fill the frame again. The crop depends on the eyes, hence the
  // iteration.
  for (int step = 0; step < 4; ++step) {
    eyes.separation = std::min(budget_px / (depth_px * scale), 1.f);
    const float shown = eyes.separation * scale;
    const float least = ends.nearest_px - before_px / shown, most = ends.farthest_px + behind_px / shown;
    eyes.zero_parallax_px = zero_parallax_px.value_or(std::clamp(0.f, std::min(least, most), most));
    scale = width / std::max(width - eyes.separation * std::abs(eyes.zero_parallax_px), width / 2);
  }
  eyes.placement = {.width = frame.width,
                    .height = frame.height,
                    .scale = static_cast<double>(scale),
                    .left = frame.width * (1 - 1 / static_cast<double>(scale)) / 2,
                    .top = frame.height * (1 - 1 / static_cast<double>(scale)) / 2,
                    .zero_parallax_px = eyes.zero_parallax_px};
  return eyes;
}

float nearest_disparity(const Painting& painting) {
  std::vector<float> disparities = disparities_of_marks(painting);
  if (disparities.empty()) return 0;
  constexpr double nearest_share = 0.995;
  return percentile(std::move(disparities), nearest_share);
}

}  // namespace wheatstone
