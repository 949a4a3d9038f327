#include "wheatstone/strokes/accents.h"

#include "wheatstone/strokes/cover_bare_internal.h"
#include "wheatstone/strokes/layer_order.h"

namespace wheatstone {

void add_accents(const SpotsOfView& spots, const Style& style, StrokePainting& painting) {
  if (painting.layers.empty()) return;
  const ScaledStyle scaled(style, spots.photograph.width());
  Style over_paint = style;
  over_paint.background = Background::colour;
  const LayerPlanner planner(spots.photograph, spots.disparity, spots.view, over_paint);
  Layer accents = cover_bare(planner, {}, scaled, style, spots.spots);
  for (ControlPoint& point : accents.points) point.x = x_in_view(point, spots.view, spots.reference_view);
  for (Stroke& accent : accents.strokes) {
    accent.reference_view = spots.reference_view;
    accent.views = spots.views;
  }
  append_strokes(accents, painting.layers.back());
}

}  // namespace wheatstone
