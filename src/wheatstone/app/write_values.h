#pragma once

#include <filesystem>
#include <string>

#include "wheatstone/depth/camera.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// The meaning of a picture's numbers, and the place of its pixels in the scene.
struct ValueAxes {
  std::string name;         ///< "column density"
  std::string unit;         ///< of the numbers
  std::string length_unit;  ///< of the axes
  Camera camera;            ///< the axes count from its axis, to the right and up, at the depth that it looks at
  float depth = 1;          ///< that it looks at
};

/// Writes a picture of numbers as 32-bit floats: FITS (.fits), OpenEXR (.exr) or NumPy (.npy), by the file's ending.
/// FITS has the bottom row first, and linear axes and units in its header; OpenEXR has the same keywords as attributes;
/// NumPy has the numbers only, the top row first. Appears only when it is whole. Throws Error{wrong_usage} for another
/// ending, Error{cannot_read_write}.
void write_values(const std::filesystem::path& path, ImageView<const float> values, const ValueAxes& axes);

/// Throws Error{wrong_usage}, beginning with `option`, where write_values knows no such ending.
void check_values_ending(const std::string& option, const std::filesystem::path& path);

}  // namespace wheatstone
