#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "wheatstone/image/grain.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/random.h"
#include "wheatstone/regions/plan_regions_internal.h"
#include "wheatstone/stereo/occlusion.h"

namespace wheatstone {
namespace {

/// What the reference view does not show lies under what it shows.
void sort_far_to_near(ViewPosition reference, RegionPainting& painting) {
  const auto key = [reference](const RegionMark& mark) {
    return std::tuple(mark.reference_view == reference, std::lround(mark.disparity));
  };
  std::ranges::stable_sort(painting.marks, {}, key);
}

}  // namespace

RegionPainting plan_regions(std::span<const View> views, const Style& style, const CutView& cut) {
  check_style(style);
  check_fits(views);
  const View& reference = views.front();
  const float scale = style_scale(style, reference.colour.width());
  const bool independent = style.propagation == Propagation::independent;
  RegionPainting painting{reference.colour.width(), reference.colour.height(), {}, {}, {}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    ViewToCut view{views[i], i, all_views, style.seed, scale, style.depth_threshold_px * scale};
    view.disparity = without_outliers(view.disparity);
    view.wanted = {};
    if (independent) view.views = {view.position, view.position};
    if (i > 0 && independent) view.seed = hash_keys({style.seed, i});
    if (i > 0 && !independent && !views[i].wanted.empty()) {
      // Grown, so that the marks reach under those of the reference view.
      constexpr float overlap_px = 3;
      view.wanted = dilate_occlusion(views[i].wanted, static_cast<int>(std::ceil(overlap_px * scale)));
    }
    const std::size_t first_point = painting.points.size();
    cut(view, style, painting);
    for (ControlPoint& point : std::span(painting.points).subspan(first_point))
      point.x += static_cast<float>(view.frame.origin_px);
  }
  std::erase_if(painting.marks, [](const RegionMark& mark) { return mark.ring_count == 0; });
  sort_far_to_near(reference.position, painting);
  return painting;
}

}  // namespace wheatstone
