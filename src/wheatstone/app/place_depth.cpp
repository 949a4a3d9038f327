#include "wheatstone/app/place_depth.h"

#include <utility>

#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/marks/mapped_depth.h"
#include "wheatstone/percentile.h"

namespace wheatstone {

DepthEnds depth_ends_of(const Painting& painting) {
  if (!painting.surfaces.seen.empty()) return depth_ends(painting.surfaces.seen.front().disparity);
  const std::vector<float> disparities = disparities_of_marks(painting);
  if (disparities.empty()) return {};
  constexpr double outliers_share = 0.005;
  return {percentile(disparities, outliers_share), percentile(disparities, 1 - outliers_share)};
}

Painting place_depth(Painting painting, const DepthPlacing& placing, int width_px) {
  if (placing.regions.empty()) return painting;
  ViewingGeometry viewing = placing.viewing;
  viewing.width_px = width_px;
  const DisparityMapping mapping = disparity_mapping(placing.regions, depth_ends_of(painting), viewing);
  return with_depth(std::move(painting), mapping);
}

}  // namespace wheatstone
