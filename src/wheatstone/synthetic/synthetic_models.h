#pragma once

#include <cstddef>
#include <cstdint>

#include "wheatstone/models/model.h"

namespace wheatstone {

// Models made by formulas, z up, with normals. Each has about as many triangles as it is told, at least a few hundred.

/// A tube along a torus knot that winds three times around the axis and twice around the ring, in colours that change
/// along it.
Model make_knot(std::size_t triangles);

/// Boxes of different heights in rows on a ground, with windows as texture.
Model make_city(std::size_t triangles, std::uint64_t seed = 1);

/// A sphere of radius 1 around 0, with a checkered map as texture.
Model make_textured_sphere(std::size_t triangles);

/// A trunk, branches, and leaves of two triangles each: most triangles are small and hide each other.
Model make_tree(std::size_t triangles, std::uint64_t seed = 1);

}  // namespace wheatstone
