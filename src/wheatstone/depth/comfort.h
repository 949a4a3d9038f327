#pragma once

#include <string>
#include <vector>

#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// Of the nearest and the farthest point together, as a share of a picture's width: what broadcasters allow (Hassaine
/// 2010, sec. 2.1.3).
inline constexpr float comfortable_parallax_share = 0.03f;

/// What of a scene between `near_mm` in front of the screen and `far_mm` behind it may strain the eyes, one sentence
/// each, with the numbers; empty where all is well. Hassaine 2010, sec. 2.1.3: on a desk, within 1 m, 10 cm either way
/// (Jones et al. 2001); farther away what broadcasters allow, 1 % of the screen's width before and 2 % behind; at any
/// distance one degree of angular disparity, and never parallax wider than the eyes.
std::vector<std::string> discomforts(const ViewingGeometry& viewing, float near_mm, float far_mm);

/// Of the nearest point and the farthest together, in % of the screen's width.
float total_parallax_percent(const ViewingGeometry& viewing, float near_mm, float far_mm);

}  // namespace wheatstone
