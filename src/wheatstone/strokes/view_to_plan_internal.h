#pragma once

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

/// What is to be planned of a view: all of it, where all is wanted, or what it alone shows, in pixels no larger than
/// they are planned in. That is grown where a scene begins, so that its strokes reach under those of the reference
/// view; later those are there, and what they may show is theirs.
View wanted_part(const View& view, const View& reference, const Style& style, bool scene_begins);

/// The part in the pixels in which its finest strokes are planned. Half the size is enough for what an eye shows; what
/// no eye shows is planned as small as its finest brush allows.
View view_to_plan(const View& part, const View& reference, const Style& style);

/// Dots, in the smaller view's pixels, for what is wanted of a view and lies before the surface of the pixel of a
/// smaller view that it became part of, or became part of none: the thin edges of near surfaces. In the order of the
/// rows.
Layer dots_left_out(const View& part, const View& smaller);

/// How many times smaller than the view a layer is planned whose brush has this radius in the reference view's pixels:
/// it keeps at least the other radius. A wide brush shows none of what gets lost, and most of what planning takes goes
/// with the pixels that are looked at.
int factor_for_layer(const View& view, float radius_px, float least_radius_px);

/// Goes on at another size, with what is painted so far.
ViewOnCanvas at_size(const View& view, const Style& style, int reference_width, const ViewOnCanvas& before);

}  // namespace wheatstone
