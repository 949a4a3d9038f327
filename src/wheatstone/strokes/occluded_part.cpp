#include "wheatstone/strokes/occluded_part.h"

#include <cmath>

#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

Image<std::uint8_t> grown_occlusion(ImageView<const std::uint8_t> occlusion, const Style& style) {
  const float largest_radius_px = ScaledStyle(style, occlusion.width()).radii_px.front();
  return dilate_occlusion(occlusion, static_cast<int>(std::lround(style.occlusion_dilation * largest_radius_px)));
}

std::vector<Layer> plan_occluded_part(View view, const Style& style) {
  view.wanted = grown_occlusion(view.wanted, style);
  const View half = smaller_view(view, 2);
  if (half.colour.empty()) return std::vector<Layer>(ScaledStyle(style, view.colour.width()).radii_px.size());
  ViewOnCanvas at(half, style, view.colour.width());
  return plan_alone(at, style);
}

}  // namespace wheatstone
