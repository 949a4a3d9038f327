#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/particles/condition.h"

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
  std::uint64_t unchosen = 0;    ///< left out: CloudChoice::where does not hold
  std::uint64_t dropped = 0;     ///< without a finite position
  std::uint64_t weightless = 0;  ///< left out: their mass is no number or below 0, or what is to be shown is no number
  std::uint64_t mended = 0;      ///< with a density or temperature that is not above 0: it got the smallest number
  std::uint64_t extreme = 0;     ///< densities and temperatures too large or too small for single precision
};

/// Puts into Cloud::chosen where the condition holds. `of_file` holds the columns that a file has under the condition's
/// names, in their order; where one is empty, the cloud's own column of that name counts (CloudChoice::where). Throws
/// Error{bad_input} that begins with `name`, where there is neither, unless it `may_lack`: then it is not a number.
/// `fields` are the names that the file has.
void mark_chosen(Cloud& cloud, const Condition& where, std::vector<QuantityColumn> of_file, const std::string& name,
                 std::span<const std::string> fields, bool may_lack = false);

/// Keeps the chosen particles, in place and in order.
void keep_chosen(Cloud& cloud);

/// Keeps what the selection asks for of the chosen particles, in place and in order. `first` is the index of the
/// cloud's first particle in its file, so that a file in chunks is thinned out as the whole would be.
SelectionCounts select_particles(Cloud& cloud, const Selection& selection, std::uint64_t first = 0);

}  // namespace wheatstone
