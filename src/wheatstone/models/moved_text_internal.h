#pragma once

#include <array>
#include <string>

namespace wheatstone {

/// Takes the middle of all vertices off each line "v X Y Z" of an OBJ file where they lie so far from 0 that single
/// precision would not tell them apart, and returns it; 0 where the text stays as it is.
std::array<double, 3> move_to_origin(std::string& obj);

}  // namespace wheatstone
