#include "wheatstone/painting/mend_spots_internal.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/nearest_surface.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/regions/accents.h"

namespace wheatstone {
namespace {

/// The disparities that marks need to be seen. In other views than the reference what is wrong is mostly a near mark in
/// a wrong place: marks must lie before it.
Image<float> disparity_for(const SceneView& view, bool is_reference, const Painting& painting) {
  constexpr int about_px = 9;
  constexpr float before_px = 1.5f;
  Image<float> disparity = nearest_surface(painting, view.position);
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x)
      if (std::isnan(disparity(x, y))) disparity(x, y) = view.disparity(x, y);
  if (is_reference) return disparity;
  Image<float> nearest(disparity.width(), disparity.height());
  cv::Mat to = as_mat(nearest);
  cv::dilate(as_mat(disparity), to, cv::getStructuringElement(cv::MORPH_RECT, {about_px, about_px}));
  for (float& value : nearest.pixels()) value += before_px;
  return nearest;
}

/// Those that are nearer to a view than to the one halfway to the reference view, and as far beyond.
ViewRange views_about(ViewPosition view, ViewPosition reference) {
  const float reach = std::abs(view - reference) / 4, at = view.eye_separations();
  return {ViewPosition(at - reach), ViewPosition(at + reach)};
}

}  // namespace

void mend_spots(std::span<const SceneView> views, const Style& style, Painting& painting) {
  if (style.marks != Marks::regions) return;
  if (style.propagation == Propagation::independent) return;
  const ViewPosition reference = views.front().position;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SceneView& view = views[i];
    if (view.continued) continue;
    const DrawnView drawn = draw(painting, view.position);
    const Image<std::uint8_t> spots = wrong_pixels(drawn.picture, view.picture);
    if (std::ranges::all_of(spots.pixels(), [](std::uint8_t wrong) { return wrong == 0; })) continue;
    const Image<float> disparity = disparity_for(view, i == 0, painting);
    const SpotsOfView found{view.picture,
                            spots,
                            disparity,
                            view.position,
                            reference,
                            i == 0 ? all_views : views_about(view.position, reference),
                            painting.surfaces.tolerance_px};
    add_accents(found, style.colours, std::get<RegionPainting>(painting.marks));
  }
}

}  // namespace wheatstone
