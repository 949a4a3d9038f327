#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "wheatstone/particles/cloud_source.h"

namespace wheatstone {

/// Particles as a reader finds them in a file: positions, in one of three ways, and all else as a cloud has it.
struct ParticleRows {
  std::vector<double> x, y, z;
  /// In place of these: x, y and z of one particle after the other, as most files hold them, in double precision or,
  /// where the file has no more, in single precision.
  std::vector<double> points;
  std::vector<float> single_points;
  Cloud others;                       ///< its positions mean nothing
  std::vector<QuantityColumn> named;  ///< of the condition's names (CloudChoice::where); empty where the file has none

  std::size_t size() const { return x.size() + (points.size() + single_points.size()) / 3; }
};

/// Puts the next rows of a file, at most so many, into rows that are empty, but for the positions of `others`, and may
/// have memory; none at the end.
using RowReader = std::function<void(std::size_t most, ParticleRows& rows)>;

/// Rows of x, y, z one after the other, as most files hold positions, each row `width` ≥ 3 numbers long.
void put_positions(std::vector<double> numbers, std::size_t width, ParticleRows& rows);

/// Lets a source give the rows of a file as clouds, those marked for which the choice's condition holds. Their
/// positions are relative to the choice's origin, and without one to a point that is chosen from the first thousand
/// rows: 0 along an axis on which they lie around 0, or near enough for single precision, and else their median. It is
/// the same however large the chunks are.
void give_rows(RowReader next, const std::filesystem::path& path, const CloudChoice& choice, CloudSource& source);

/// The nearest number of single precision that is finite and, where the value is not 0, not 0: what is too large or too
/// small becomes the largest or the smallest number.
float in_single_precision(double value);

/// Each value in single precision, as above.
std::vector<float> in_single_precision(const std::vector<double>& values);

}  // namespace wheatstone
