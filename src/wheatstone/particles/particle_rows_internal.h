#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

/// Particles as a reader finds them in a file: positions in double precision, and all else as a cloud has it.
struct ParticleRows {
  std::vector<double> x, y, z;
  Cloud others;  ///< has no positions

  std::size_t size() const { return x.size(); }
};

/// The next rows of a file, at most so many; none at the end.
using RowReader = std::function<ParticleRows(std::size_t most)>;

/// Rows of x, y, z one after the other, as most files hold positions, each row `width` ≥ 3 numbers long.
void put_positions(const std::vector<double>& numbers, std::size_t width, ParticleRows& rows);

/// A reader of clouds, whose positions are relative to `origin`, and without one to a point that is chosen from the
/// first thousand rows: 0 along an axis on which they lie around 0, or near enough for single precision, and else their
/// median. It is the same however large the chunks are.
std::function<Cloud(std::size_t most)> cloud_reader(RowReader next, std::optional<std::array<double, 3>> origin);

/// The nearest number of single precision that is finite and, where the value is not 0, not 0: what is too large or too
/// small becomes the largest or the smallest number.
float in_single_precision(double value);

/// Each value in single precision, as above.
std::vector<float> in_single_precision(const std::vector<double>& values);

}  // namespace wheatstone
