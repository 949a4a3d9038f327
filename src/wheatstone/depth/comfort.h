#pragma once

#include <string>
#include <vector>

#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// What of a scene between `near_mm` in front of the screen and `far_mm` behind it may strain the eyes, one sentence
/// each, with the numbers; empty where all is well. Hassaine 2010, sec. 2.1.3: on a desk, within 1 m, 10 cm either way
/// (Jones et al. 2001); at any distance one degree of angular disparity, and never parallax wider than the eyes.
std::vector<std::string> discomforts(const ViewingGeometry& viewing, float near_mm, float far_mm);

/// Angular disparity, in degrees, of a point `behind_mm` behind the screen: the eyes' vergence there less that on the
/// screen, positive in front (eqs. 2.1.1, 2.1.2, 2.1.5).
float angular_disparity_deg(const ViewingGeometry& viewing, float behind_mm);

}  // namespace wheatstone
