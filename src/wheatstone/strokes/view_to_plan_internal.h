#pragma once

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

/// The part of a view that is to be planned: the whole view if all of it is wanted, otherwise the part that it alone
/// shows, in pixels no larger than those in which it is planned. This part is grown at the beginning of a scene, so
/// that its strokes reach under those of the reference view. Later the reference view's strokes are there already, and
/// all that they may show is left to them.
View wanted_part(const View& view, const View& reference, const Style& style, bool scene_begins);

/// The part in the pixels in which its finest strokes are planned. Half the size is enough for what an eye shows; what
/// no eye shows is planned as small as its finest brush allows.
View view_to_plan(const View& part, const View& reference, const Style& style);

/// Dots, in the smaller view's pixels, for the thin edges of near surfaces that the smaller view has lost: the wanted
/// pixels of `part` that lie before the surface of the smaller pixel that contains them, or that no smaller pixel
/// contains. In the order of the rows.
Layer dots_left_out(const View& part, const View& smaller);

/// How many times smaller than the view a layer is planned. Its brush has `radius_px` in the reference view's pixels,
/// and keeps at least `least_radius_px`. A wide brush shows none of the lost detail, and planning time is mostly
/// proportional to the number of pixels.
int factor_for_layer(const View& view, float radius_px, float least_radius_px);

}  // namespace wheatstone
