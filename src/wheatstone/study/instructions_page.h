#pragma once

#include <string>

#include "wheatstone/study/study_design.h"

namespace wheatstone {

/// A page (HTML, to be printed) with what a subject reads before it begins, and on a second sheet what the person does
/// who runs the study. `folder` is that of the data, in which the design and the stimuli lie.
std::string instructions_page(const StudyDesign& design, const std::string& folder);

}  // namespace wheatstone
