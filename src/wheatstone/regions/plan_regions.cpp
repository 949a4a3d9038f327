#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "wheatstone/image/grain.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/motion/fitting_scene.h"
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

RegionPainting plan_regions(std::span<const SceneView> views, const Style& style, const CutView& cut) {
  check_style(style);
  check_fits(views);
  const int width = views[0].picture.width();
  const float scale = style_scale(style, width);
  const bool independent = style.propagation == Propagation::independent;
  RegionPainting painting{width, views[0].picture.height(), {}, {}, {}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SceneView& view = views[i];
    const Image<float> disparity = without_outliers(view.disparity);
    ViewToCut to_cut{.photograph = view.picture,
                     .disparity = disparity,
                     .mask = {},
                     .number = i,
                     .view = view.position,
                     .views = all_views,
                     .seed = style.seed,
                     .scale = scale,
                     .depth_threshold_px = style.depth_threshold_px * scale};
    if (independent) to_cut.views = {view.position, view.position};
    if (i > 0 && independent) to_cut.seed = hash_keys({style.seed, i});
    Image<std::uint8_t> only_here;
    if (i > 0 && !independent && !view.only_here.empty()) {
      // Grown, so that the marks reach under those of the reference view.
      constexpr float overlap_px = 3;
      only_here = dilate_occlusion(view.only_here, static_cast<int>(std::ceil(overlap_px * scale)));
      to_cut.mask = only_here;
    }
    cut(to_cut, style, painting);
  }
  std::erase_if(painting.marks, [](const RegionMark& mark) { return mark.ring_count == 0; });
  sort_far_to_near(views[0].position, painting);
  return painting;
}

}  // namespace wheatstone
