#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/drawing/prepared_strokes_internal.h"

namespace wheatstone {

/// For every layer, and every stroke of it, in drawing order: 1 where it changes a pixel of the drawn picture, 0 where
/// the view does not show it or nearer strokes or surfaces hide it wholly. What would change no pixel by more than
/// `least_share` of its colour's distance counts as hidden.
std::vector<std::vector<std::uint8_t>> visible_strokes(const PreparedStrokes& painting, ViewPosition view,
                                                       const Hiding& hiding, float least_share);

}  // namespace wheatstone
