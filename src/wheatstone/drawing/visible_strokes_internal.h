#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// For every layer, and every stroke of it that the view shows, in drawing order: 1 where it changes a pixel of the
/// drawn picture, 0 where nearer strokes hide it wholly. What would change no pixel by more than `least_share` of its
/// colour's distance counts as hidden.
std::vector<std::vector<std::uint8_t>> visible_strokes(const StrokePainting& painting, ViewPosition view,
                                                       float least_share);

}  // namespace wheatstone
