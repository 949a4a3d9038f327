#pragma once

#include "wheatstone/app/output_folder.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The same painting, `scale` times as large: marks are shapes, so nothing is lost.
/// Throws Error{wrong_usage} where the result would be over 65535 pixels a side.
Painting scaled(const Painting& painting, double scale);

struct RedrawOptions {
  double scale = 1;  ///< how many times as large
  bool svg = false;  ///< also left.svg and right.svg, the marks as vectors
};

/// Draws a painting again, for both eyes, over its canvas colour: left.png, right.png, side_by_side.png and
/// anaglyph.png in a folder, which is committed. The nearest mark's depth, but for outliers, lies on the
/// screen plane. Throws Error as the folder and `scaled` do.
void draw_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options = {});

}  // namespace wheatstone
