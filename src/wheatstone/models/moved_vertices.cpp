#include <algorithm>
#include <cmath>

#include "wheatstone/models/moved_vertices_internal.h"

namespace wheatstone {

void VertexBox::add(const std::array<double, 3>& position) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least_[axis] = std::min(least_[axis], position[axis]);
    most_[axis] = std::max(most_[axis], position[axis]);
  }
}

std::array<double, 3> VertexBox::middle_if_far() const {
  std::array<double, 3> middle{};
  double farthest = 0, size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(least_[axis] <= most_[axis])) return {};
    farthest = std::max({farthest, std::abs(least_[axis]), std::abs(most_[axis])});
    size = std::max(size, most_[axis] - least_[axis]);
    middle[axis] = least_[axis] / 2 + most_[axis] / 2;
  }
  // Nearer to 0, single precision tells a hundred-thousandth of the size apart.
  constexpr double far_in_sizes = 100;
  return farthest <= far_in_sizes * size ? std::array<double, 3>{} : middle;
}

}  // namespace wheatstone
