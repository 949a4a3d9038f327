#include "wheatstone/marks/surfaces.h"

#include <algorithm>

namespace wheatstone {

namespace {

template <class Counts>
ViewRange range_of(const Surfaces& surfaces, Counts counts) {
  ViewRange range{central_view, central_view};
  if (!surfaces.seen.empty()) range = {surfaces.seen.front().view, surfaces.seen.front().view};
  for (const Surface& surface : surfaces.seen) {
    if (!counts(surface)) continue;
    range.first = std::min(range.first, surface.view);
    range.last = std::max(range.last, surface.view);
  }
  return range;
}

}  // namespace

ViewRange photographed_views(const Surfaces& surfaces) {
  return range_of(surfaces, [](const Surface& surface) { return !surface.continued; });
}

ViewRange known_views(const Surfaces& surfaces) {
  return range_of(surfaces, [](const Surface&) { return true; });
}

}  // namespace wheatstone
