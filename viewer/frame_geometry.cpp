#include "frame_geometry.h"

namespace wheatstone::viewer {

std::optional<PlaceInView> place_at(const std::vector<ViewPlace>& places, double x, double y) {
  for (const ViewPlace& place : places) {
    if (x < place.left || y < place.top || x >= place.left + place.width || y >= place.top + place.height) continue;
    return PlaceInView{place.view, ((x - place.left) / place.squeeze_x - place.origin_x) / place.scale,
                       ((y - place.top) / place.squeeze_y - place.origin_y) / place.scale};
  }
  return {};
}

}  // namespace wheatstone::viewer
