#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Particles as a structure of arrays, in the units of their file. x, y and z are as long as the cloud; every other
/// column is as long, or empty where the file does not have it.
struct Cloud {
  std::vector<float> x, y, z;
  std::vector<float> density;
  std::vector<float> temperature;  ///< kelvin in snapshots; any other scalar where the user names one
  std::vector<float> smoothing_length;
  std::vector<Rgb8> colour;
  /// Taken off every position in double precision when it was read, so that single precision suffices far from 0: an
  /// easting of 4 500 000 m. The same in all chunks of a file.
  std::array<double, 3> origin{};
  /// The largest coordinate of the file that lies farther from the origin than `farthest_drawn`; 0 where none does.
  double farthest = 0;
  double box_size = 0;  ///< of a periodic box [0, box_size)³; 0 where there is none

  /// Distances are computed in single precision: their squares must not overflow.
  static constexpr float farthest_drawn = 1e18f;

  std::size_t size() const { return x.size(); }
};

}  // namespace wheatstone
