#pragma once

#include "wheatstone/particles/cloud.h"
#include "wheatstone/progress.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// Gives a cloud density and smoothing length where its file has none: smoothed-particle estimates over each particle's
/// `neighbours` nearest, itself among them, with the cubic spline kernel (Monaghan 1992); the smoothing length reaches
/// to the farthest of them. Particles are of mass 1, so that density is their number a unit of volume. Periodic where
/// the cloud's box is. Positions are finite. All ranks have the same cloud, and each looks at its part of the
/// particles.
void estimate_density(Cloud& cloud, int neighbours = 32, const Progress& progress = {}, const Ranks& ranks = {});

}  // namespace wheatstone
