#include "wheatstone/marks/surfaces.h"

#include <algorithm>
#include <cmath>

namespace wheatstone {

bool operator==(const Surface& a, const Surface& b) {
  const auto same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.view == b.view && a.left_px == b.left_px && a.continued == b.continued &&
         a.disparity.width() == b.disparity.width() && a.disparity.height() == b.disparity.height() &&
         std::ranges::equal(a.disparity.pixels(), b.disparity.pixels(), same);
}

ViewRange known_views(const Surfaces& surfaces) {
  ViewRange known{central_view, central_view};
  if (!surfaces.seen.empty()) known = {surfaces.seen.front().view, surfaces.seen.front().view};
  for (const Surface& surface : surfaces.seen) {
    known.first = std::min(known.first, surface.view);
    known.last = std::max(known.last, surface.view);
  }
  return known;
}

}  // namespace wheatstone
