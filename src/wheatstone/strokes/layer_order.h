#pragma once

#include <cstdint>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Adds the strokes of one layer behind those of another.
void append_strokes(const Layer& part, Layer& whole);

/// Puts a layer's strokes into drawing order: far to near by their disparity in whole pixels, and strokes of equal
/// depth by one seeded permutation, so that no regular overlap shows (Stavrakis & Gelautz 2004, sec. 3.2). There is one
/// order, whatever the view.
void sort_far_to_near(Layer& layer, std::uint64_t seed);

/// The same for strokes with numbers: each lies up to half a pixel of disparity nearer or farther than it is, as its
/// number decides, so that strokes that move together keep their order from frame to frame. Fitted strokes stay in the
/// order of their numbers, since each is planned on those before it.
void put_in_order(Layer& layer, const Style& style);

}  // namespace wheatstone
