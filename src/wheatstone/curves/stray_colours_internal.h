#pragma once

#include "wheatstone/curves/diffusion_lines_internal.h"

namespace wheatstone {

/// Colours that change too gradually for an edge, as that of a soft shadow, spread over all that no other line bounds.
/// Where the lines of a view, drawn small, differ much from its picture, dots of the picture's colour are added, on a
/// fixed grid, so that they stand still in a film that does.
void add_dots_where_colours_stray(const ViewOfEdges& view, DiffusionPainting& painting);

}  // namespace wheatstone
