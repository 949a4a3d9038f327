#pragma once

#include <array>
#include <limits>
#include <string>

namespace wheatstone {

// The importer keeps coordinates in single precision. These take the middle of all vertices off the vertices of a file
// where they lie so far from 0 that single precision would not tell them apart, and return it; 0 where the file stays
// as it is.

/// Of an OBJ file: its lines "v X Y Z".
std::array<double, 3> move_obj_to_origin(std::string& obj);

/// Of a PLY file whose vertices come first, as numbers without lists: written ones of any type, and binary ones in
/// double precision.
std::array<double, 3> move_ply_to_origin(std::string& ply);

/// The box around vertices.
class VertexBox {
 public:
  void add(const std::array<double, 3>& position);
  /// The middle to be taken off; 0 where that is not necessary.
  std::array<double, 3> middle_if_far() const;

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> least_{infinity, infinity, infinity}, most_{-infinity, -infinity, -infinity};
};

}  // namespace wheatstone
