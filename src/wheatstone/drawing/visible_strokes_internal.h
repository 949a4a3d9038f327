#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/drawing/prepared_strokes_internal.h"

namespace wheatstone {

/// Marks with 1 what changes a pixel of the drawn picture, for every layer and every stroke of it, in drawing order;
/// what the view does not show, or nearer strokes or surfaces hide wholly, stays as it is. What would change no pixel
/// by more than `least_share` of its colour's distance counts as hidden. What is marked already costs no look.
void mark_visible(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding, float least_share,
                  std::span<std::vector<std::uint8_t>> visible);

/// The marks of one view: 0 for what is hidden.
std::vector<std::vector<std::uint8_t>> visible_strokes(const PreparedStrokes& painting, ViewPosition view,
                                                       const Hiding& hiding, float least_share);

}  // namespace wheatstone
