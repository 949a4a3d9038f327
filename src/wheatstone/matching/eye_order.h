#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How clearly a pair tells which picture is the left eye's.
struct EyeOrderEvidence {
  int bands = 0;  ///< places that only one eye sees, beside a step in depth, whose colour tells where they belong
  double for_order = 0;  ///< −1..1: share of those bands that belong to the farther surface, less those to the nearer
};

/// What one eye alone sees lies behind what hides it from the other: it goes on like the surface that is then the
/// farther one. With the eyes swapped near and far change places, but not what goes on like what.
EyeOrderEvidence eye_order_evidence(const StereoPair& pair);

/// Whether the pair shows that its pictures are each other's: enough bands, and most of them belong to the surface that
/// would be nearer. False where it is undecided. The sign of the disparities alone tells nothing: converged cameras and
/// mounted pairs have both.
bool eyes_look_swapped(const StereoPair& pair);

}  // namespace wheatstone
