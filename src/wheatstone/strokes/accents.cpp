#include "wheatstone/strokes/accents.h"

#include <algorithm>
#include <utility>

#include "wheatstone/strokes/cover_bare_internal.h"
#include "wheatstone/strokes/layer_order.h"

namespace wheatstone {

void add_accents(const SpotsOfView& spots, const Style& style, StrokePainting& painting) {
  if (painting.layers.empty()) return;
  const ScaledStyle scaled(style, spots.photograph.width());
  Image<std::uint8_t> bare(spots.spots.width(), spots.spots.height());
  for (int y = 0; y < bare.height(); ++y) std::ranges::copy(spots.spots.row(y), bare.row(y).begin());
  Layer accents = cover_places({spots.photograph, spots.disparity, spots.view, {}, std::move(bare)}, scaled, style);
  for (ControlPoint& point : accents.points) point.x = x_in_view(point, spots.view, spots.reference_view);
  for (Stroke& accent : accents.strokes) {
    accent.reference_view = spots.reference_view;
    accent.views = spots.views;
  }
  append_strokes(accents, painting.layers.back());
}

}  // namespace wheatstone
