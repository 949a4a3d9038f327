#pragma once

#include <optional>

#include "wheatstone/matching/match.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How clearly a pair tells which picture is the left eye's.
struct EyeOrderEvidence {
  int bands = 0;  ///< places that only one eye sees, beside a step in depth, whose colour tells where they belong
  double for_order = 0;  ///< −1..1: share of those bands that belong to the farther surface, less those to the nearer
};

/// What one eye alone sees lies behind what hides it from the other: it goes on like the surface that is then the
/// farther one. With the eyes swapped near and far change places, but not what goes on like what. `within`: the
/// disparities that are looked for, in pixels of the pair; none: a quarter of the width to either side.
EyeOrderEvidence eye_order_evidence(const StereoPair& pair, const std::optional<DisparityRange>& within = {});

/// Whose pictures those of a pair look like.
enum class EyeOrder {
  undecided,  ///< too few bands, or they do not agree
  as_given,   ///< most bands belong to the farther surface
  swapped,    ///< the left picture is the right eye's
};

/// What the pair shows of the order of its pictures. The sign of the disparities alone tells nothing: converged cameras
/// and mounted pairs have both. Pictures less than about a hundred pixels wide are mostly undecided.
EyeOrder eye_order(const StereoPair& pair, const std::optional<DisparityRange>& within = {});

}  // namespace wheatstone
