#include "wheatstone/particles/select.h"

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "wheatstone/particles/all_of_column.h"

namespace wheatstone {
namespace {

constexpr float least = std::numeric_limits<float>::min();

/// Moves positions so that `centre` comes to the middle of the periodic box, which becomes their origin.
void wrap(Cloud& cloud, const std::array<double, 3>& centre) {
  const std::array<std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  const double box = cloud.box_size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double shift = cloud.origin[axis] - centre[axis];
    const auto side = static_cast<float>(box / 2);
    for (float& value : *axes[axis]) {
      const double moved = static_cast<double>(value) + shift;
      value = static_cast<float>(moved - box * std::floor(moved / box + 0.5));
      if (value >= side) value = -side;  // rounded up to the far side, which is the near one
    }
    cloud.origin[axis] = box / 2;
  }
}

bool inside(const Cut& cut, const std::array<double, 3>& at) {
  if (const Sphere* sphere = std::get_if<Sphere>(&cut)) {
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) square += std::pow(at[axis] - sphere->centre[axis], 2);
    return square <= sphere->radius * sphere->radius;
  }
  if (const Box* box = std::get_if<Box>(&cut)) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < box->lower[axis] || at[axis] > box->upper[axis]) return false;
  }
  return true;
}

/// Whether every number lies between two others. Nearly always all do, and then nothing is asked of each.
bool all_between(const std::vector<float>& column, float lower, float upper) {
  return all_of_column(column, [=](float value) { return (value > lower) & (value < upper); });
}

void mend(std::vector<float>& column, SelectionCounts& counts) {
  if (all_between(column, least, std::numeric_limits<float>::max())) return;
  for (float& value : column) {
    // Readers put what single precision cannot hold at its limits.
    if (value == least || value == std::numeric_limits<float>::max()) ++counts.extreme;
    if (value >= least && std::isfinite(value)) continue;
    value = least;
    ++counts.mended;
  }
}

/// Whether a particle's mass is a number of at least 0, and what is to be shown of it a number.
bool counts_for_something(const Cloud& cloud, std::size_t i) {
  if (!cloud.mass.empty() && !(cloud.mass[i] >= 0 && std::isfinite(cloud.mass[i]))) return false;
  return cloud.quantity.empty() || std::isfinite(cloud.quantity[i]);
}

/// The particles that are kept stand for those that are not: each is as heavy as so many, and as wide as their number
/// asks for.
void stand_for(Cloud& cloud, std::uint64_t every) {
  const auto times = static_cast<float>(every);
  for (float& mass : cloud.mass) mass *= times;
  if (cloud.mass.empty()) cloud.presence.assign(cloud.size(), times);
  const auto wider = static_cast<float>(std::cbrt(static_cast<double>(every)));
  for (float& length : cloud.smoothing_length) length *= wider;
}

bool keeps_all(const Cloud& cloud, const Selection& selection) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  return selection.every <= 1 && selection.cut.index() == 0 && all_between(cloud.x, -infinite, infinite) &&
         all_between(cloud.y, -infinite, infinite) && all_between(cloud.z, -infinite, infinite) &&
         all_between(cloud.mass, -1e-45f, infinite) && all_between(cloud.quantity, -infinite, infinite);
}

template <class Value>
void keep(std::vector<Value>& column, const std::vector<std::uint32_t>& kept) {
  if (column.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) column[i] = column[kept[i]];
  column.resize(kept.size());
}

}  // namespace

SelectionCounts select_particles(Cloud& cloud, const Selection& selection, std::uint64_t first) {
  SelectionCounts counts;
  if (selection.centre && cloud.box_size > 0) wrap(cloud, *selection.centre);
  std::vector<std::uint32_t> kept;
  const bool all = keeps_all(cloud, selection);
  for (std::size_t i = 0; !all && i < cloud.size(); ++i) {
    if (!std::isfinite(cloud.x[i]) || !std::isfinite(cloud.y[i]) || !std::isfinite(cloud.z[i])) {
      ++counts.dropped;
      continue;
    }
    if (!counts_for_something(cloud, i)) {
      ++counts.weightless;
      continue;
    }
    if (selection.every > 1 && (first + i) % selection.every != 0) continue;
    if (selection.cut.index() != 0 &&
        !inside(selection.cut,
                {cloud.x[i] + cloud.origin[0], cloud.y[i] + cloud.origin[1], cloud.z[i] + cloud.origin[2]}))
      continue;
    kept.push_back(static_cast<std::uint32_t>(i));
  }
  if (!all && kept.size() < cloud.size()) {
    std::apply([&](auto&... column) { (keep(column, kept), ...); }, columns_of(cloud));
  }
  if (selection.every > 1) stand_for(cloud, selection.every);
  mend(cloud.density, counts);
  mend(cloud.temperature, counts);
  // Without a length a particle is a point.
  for (float& length : cloud.smoothing_length)
    length = length >= 0 && length <= std::numeric_limits<float>::max() ? length : 0;
  return counts;
}

}  // namespace wheatstone
