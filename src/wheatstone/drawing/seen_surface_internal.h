#pragma once

#include <cstdint>

#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/surfaces.h"

namespace wheatstone {

/// Where a mark was planned, which decides what surfaces may hide it.
enum class PlannedIn : std::uint8_t { reference_view, photographed_view, other_view };
PlannedIn kind_of(ViewPosition planned_in, const Surfaces& surfaces);

/// What hides a painting's marks in some rows of one view.
struct SeenSurfaces {
  Image<float> nearest, reference, photographed;
  Hiding hiding;  ///< refers to these images
};

/// Some rows of a view.
struct RowsOfView {
  int width;
  int first_row, row_count;
};

/// Empty where the painting has no surfaces.
SeenSurfaces seen_surfaces(const Surfaces& surfaces, ViewPosition view, const RowsOfView& rows);

}  // namespace wheatstone
