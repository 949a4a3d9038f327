#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "wheatstone/particles/cloud.h"

namespace wheatstone {

/// What of a cloud is kept. Lengths and points are in the file's own units.
struct Sphere {
  std::array<double, 3> centre;
  double radius;
};
struct Box {
  std::array<double, 3> lower, upper;
};
using Cut = std::variant<std::monostate, Sphere, Box>;

struct Selection {
  std::optional<std::array<double, 3>> centre;  ///< moved to the middle of a periodic box
  Cut cut;
  std::uint64_t every = 1;  ///< keep one particle of so many, with the mass of all of them
};

/// What was left out, or put right.
struct SelectionCounts {
  std::uint64_t dropped = 0;     ///< without a finite position
  std::uint64_t weightless = 0;  ///< left out: their mass is no number or below 0, or what is to be shown is no number
  std::uint64_t mended = 0;      ///< with a density or temperature that is not above 0: it got the smallest number
  std::uint64_t extreme = 0;     ///< densities and temperatures too large or too small for single precision
};

/// Keeps what the selection asks for, in place and in order. `first` is the index of the cloud's first particle in its
/// file, so that a file in chunks is thinned out as the whole would be.
SelectionCounts select_particles(Cloud& cloud, const Selection& selection, std::uint64_t first = 0);

}  // namespace wheatstone
