#pragma once

#include <span>
#include <vector>

#include "wheatstone/drawing/draw.h"

namespace wheatstone {

/// Draws regions or curves, which were planned for two eyes, for any views between and beyond them; one picture for
/// each position, in their order. A mark that one eye alone sees is drawn beyond that eye too. Regions hide each other
/// by their disparities, and what they leave bare, which is counted, takes the colour of its farther neighbour. Throws
/// Error{wrong_usage} for a painting of strokes, which `widen` prepares.
std::vector<DrawnView> draw_other_views(const Painting& painting, std::span<const ViewPosition> positions);

}  // namespace wheatstone
