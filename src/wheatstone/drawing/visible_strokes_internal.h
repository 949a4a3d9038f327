#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/drawing/prepared_strokes_internal.h"

namespace wheatstone {

/// Sets 1 for every stroke that changes a pixel of the drawn picture: for each layer, its strokes in drawing order.
/// Strokes that the view does not show, or that nearer strokes or surfaces hide wholly, keep their value. A stroke that
/// would change no pixel by more than `least_share` of its colour's distance counts as hidden. Strokes that are 1
/// already are not examined.
void mark_visible(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding, float least_share,
                  std::span<std::vector<std::uint8_t>> visible);

/// The marks of one view: 0 for what is hidden.
std::vector<std::vector<std::uint8_t>> visible_strokes(const PreparedStrokes& painting, ViewPosition view,
                                                       const Hiding& hiding, float least_share);

}  // namespace wheatstone
