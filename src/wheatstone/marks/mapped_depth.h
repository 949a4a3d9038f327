#pragma once

#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The painting with other disparities. Marks and surfaces stay where the reference view, that of the first surface,
/// or the left eye where there is none, sees them; what another view was planned for moves along its rows, to where the
/// reference view has it: x' = x + (v − v_ref)(d − d'). A mapping that makes all disparities s times as large is the
/// same as eyes s times as far from the reference view.
Painting with_depth(Painting painting, const DisparityMapping& mapping);

}  // namespace wheatstone
