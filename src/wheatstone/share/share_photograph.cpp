#include "wheatstone/share/share_photograph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/surface_parts_internal.h"
#include "wheatstone/stereo/view_scale.h"

namespace wheatstone {
namespace {

/// What a view of the scene is the first to show.
Surface surface_of(const View& view) {
  Surface surface{view.position, Image<float>(view.disparity.width(), view.disparity.height()), view.frame.origin_px,
                  view.continued};
  for (int y = 0; y < view.disparity.height(); ++y)
    for (int x = 0; x < view.disparity.width(); ++x)
      surface.disparity(x, y) = view.wanted.empty() || view.wanted(x, y) != 0 ? view.disparity(x, y)
                                                                              : std::numeric_limits<float>::quiet_NaN();
  return surface;
}

}  // namespace

SharedPicture share_photograph(const StereoPair& photographs, const StereoGeometry& geometry,
                               const std::string& title) {
  constexpr ViewRange wanted{ViewPosition(-1.f), ViewPosition(1.f)};
  const std::vector<View> scene = at_reference_scale(make_still_scene(photographs, geometry, wanted));
  SharedPicture shared{.width = photographs.left.width(), .height = photographs.left.height()};
  Surfaces surfaces;
  std::vector<Image<Rgb8>> pictures;
  for (const View& view : scene) {
    surfaces.seen.push_back(surface_of(view));
    pictures.push_back(copy_of(view.colour));
  }
  const DepthEnds ends = depth_ends(geometry.left_disparity);
  const float depth_px = std::max(ends.nearest_px - ends.farthest_px, 1e-3f),
              budget_px = comfortable_parallax_share * static_cast<float>(shared.width);
  Json facts{{"kind", "layered"},
             {"title", title},
             {"width", shared.width},
             {"height", shared.height},
             {"separation", std::min(budget_px / depth_px, 1.f)},
             {"zeroParallax", ends.nearest_px},
             {"first", wanted.first.eye_separations()},
             {"last", wanted.last.eye_separations()}};
  facts["surfaces"] = add_surfaces(surfaces, shared.parts);
  add_pictures(pictures, surfaces, shared.parts);
  shared.facts = text_of(facts);
  shared.still_jpeg = still_of(photographs.left);
  return shared;
}

}  // namespace wheatstone
