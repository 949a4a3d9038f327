#include "wheatstone/models/model.h"

#include <algorithm>
#include <cmath>

namespace wheatstone {

std::array<double, 3> ModelBounds::middle() const {
  std::array<double, 3> middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = least[axis] / 2 + most[axis] / 2;
  return middle;
}

std::array<double, 3> ModelBounds::size() const {
  std::array<double, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) size[axis] = most[axis] - least[axis];
  return size;
}

double ModelBounds::radius() const {
  const std::array<double, 3> across = size();
  return std::hypot(across[0], across[1], across[2]) / 2;
}

ModelBounds bounds_of(const Model& model) {
  ModelBounds bounds{model.positions.front(), model.positions.front()};
  for (const std::array<double, 3>& position : model.positions)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.least[axis] = std::min(bounds.least[axis], position[axis]);
      bounds.most[axis] = std::max(bounds.most[axis], position[axis]);
    }
  return bounds;
}

}  // namespace wheatstone
