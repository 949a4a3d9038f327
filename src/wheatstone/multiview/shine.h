#pragma once

#include <memory>

#include "wheatstone/particles/density_grid.h"

namespace wheatstone {

/// A highlight that moves from view to view, light that depends on where it is seen from (which Hassaine 2010, sec.
/// 7.2.2, leaves open). Clumps of particles shine as smooth bodies do where they mirror a lamp at the upper left: their
/// surface faces to where the density falls (Blinn 1977).
struct Shine {
  float strength = 0;  ///< light at the middle of a highlight, times a particle's own
  float sharpness =
      40;          ///< exponent of the cosine between the surface's normal and the direction that mirrors the lamp
  float turn = 0;  ///< angle between the directions in which both eyes look, in radians
  std::shared_ptr<const DensityGrid> grid;  ///< of all particles; without it nothing shines
  bool lit() const { return strength > 0 && grid != nullptr; }
};

}  // namespace wheatstone
