#pragma once

#include <string>
#include <vector>

#include "wheatstone/study/analysis.h"

namespace wheatstone {

/// Means with bars of one standard error, one column a condition.
std::string means_figure(const MeasureAnalysis& measure);

/// Box plots of how far heads moved to the sides.
std::string head_movement_figure(const std::vector<HeadMovement>& movement);

}  // namespace wheatstone
