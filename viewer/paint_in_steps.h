#pragma once

#include <functional>
#include <memory>

#include "content.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/progress.h"

namespace wheatstone::viewer {

/// Paints a photograph, coarse at once and then fine: `deliver` gets the photograph with its geometry, where that is
/// not known yet, then a painting of a small copy, enlarged, then the painting as `wheatstone paint` makes it. Throws
/// as paint_photograph does; what `progress` throws ends it.
void paint_in_steps(const std::shared_ptr<const Photograph>& photograph, const Style& style, const Progress& progress,
                    const std::function<void(PaintedContent)>& deliver);

}  // namespace wheatstone::viewer
