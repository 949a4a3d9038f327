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
  /// Taken off every position when it was read, so that single precision suffices: a statistics's easting of 4 500 000
  /// m.
  std::array<double, 3> origin{};
  double box_size = 0;  ///< of a periodic box [0, box_size)³; 0 where there is none

  std::size_t size() const { return x.size(); }
};

}  // namespace wheatstone
