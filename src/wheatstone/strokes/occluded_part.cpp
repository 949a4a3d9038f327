#include "wheatstone/strokes/occluded_part.h"

#include <cmath>

#include "wheatstone/image/reduced_view.h"
#include "wheatstone/marks/resize_strokes.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {

Image<std::uint8_t> grown_occlusion(ImageView<const std::uint8_t> occlusion, const Style& style) {
  const float largest_radius_px = ScaledStyle(style, occlusion.width()).radii_px.front();
  return dilate_occlusion(occlusion, static_cast<int>(std::lround(style.occlusion_dilation * largest_radius_px)));
}

StrokePainting plan_occluded_part(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                                  ImageView<const std::uint8_t> occlusion, ViewPosition view, const Style& style) {
  const int width = photograph.width(), height = photograph.height();
  const Image<std::uint8_t> seeds = grown_occlusion(occlusion, style);
  constexpr int reduction = 2;
  const ReducedView half = reduced(photograph, disparity, seeds, reduction);
  StrokePainting part{width,
                      height,
                      style.canvas_colour,
                      std::vector<Layer>(ScaledStyle(style, width).radii_px.size()),
                      true,
                      brush_for(style, width)};
  if (half.photograph.empty()) return part;

  LayerPlanner planner(half.photograph, half.disparity, view, style);
  planner.avoid_mixed_colours = false;  // no other eye sees them
  part.layers = plan_alone(planner, style, ScaledStyle(style, width, reduction), half.seeds).layers;
  for (Layer& layer : part.layers) resize_strokes(layer, reduction);
  return part;
}

}  // namespace wheatstone
