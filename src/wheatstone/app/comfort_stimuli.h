#pragma once

#include <string>
#include <vector>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// The versions of a stereo photograph whose comfort is compared (Bukenberger et al. 2015, section 5).
struct ComfortVersions {
  StereoPair original;
  StereoPair consistent;    ///< painted once for both eyes
  StereoPair inconsistent;  ///< each eye painted by itself
};

/// Paints a rectified pair both ways. Throws as paint_photograph.
ComfortVersions comfort_versions(const StereoPair& photographs, const PaintPhotographOptions& options,
                                 const Progress& progress = {});

/// The built-in design painting-comfort for pictures of these names: as many trials as there are pictures for. Throws
/// Error{wrong_usage} where there are fewer than three.
std::string comfort_design(const std::vector<std::string>& pictures);

}  // namespace wheatstone
