#include "wheatstone/particles/select.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/particles/all_of_column.h"
#include "wheatstone/particles/columns_internal.h"

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
  if (cloud.mass.empty()) {
    cloud.presence.resize(cloud.size(), 1.f);
    for (float& presence : cloud.presence) presence *= times;
  }
  const auto wider = static_cast<float>(std::cbrt(static_cast<double>(every)));
  for (float& length : cloud.smoothing_length) length *= wider;
}

bool all_chosen(const Cloud& cloud) { return std::ranges::find(cloud.chosen, std::uint8_t{0}) == cloud.chosen.end(); }

bool keeps_all(const Cloud& cloud, const Selection& selection) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  return all_chosen(cloud) && selection.every <= 1 && selection.cut.index() == 0 &&
         all_between(cloud.x, -infinite, infinite) && all_between(cloud.y, -infinite, infinite) &&
         all_between(cloud.z, -infinite, infinite) && all_between(cloud.mass, -1e-45f, infinite) &&
         all_between(cloud.quantity, -infinite, infinite);
}

template <class Value>
void keep(std::vector<Value>& column, const std::vector<std::uint32_t>& kept) {
  if (column.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) column[i] = column[kept[i]];
  column.resize(kept.size());
}

void keep_rows(Cloud& cloud, const std::vector<std::uint32_t>& kept) {
  if (kept.size() < cloud.size()) std::apply([&](auto&... column) { (keep(column, kept), ...); }, columns_of(cloud));
}

/// A column that clouds have, by the name that files may have for it.
struct OwnColumn {
  std::string_view name;
  std::vector<float> Cloud::*column;
  int axis = -1;  ///< of a position
};
constexpr std::array<OwnColumn, 8> own_columns{{{"x", &Cloud::x, 0},
                                                {"y", &Cloud::y, 1},
                                                {"z", &Cloud::z, 2},
                                                {"density", &Cloud::density},
                                                {"temperature", &Cloud::temperature},
                                                {"smoothing_length", &Cloud::smoothing_length},
                                                {"mass", &Cloud::mass},
                                                {"quantity", &Cloud::quantity}}};

/// A name without what writers of files do as they like: "smoothinglength" of "SmoothingLength" and "smoothing_length".
std::string plain_name(std::string_view name) {
  std::string plain = lower_case(std::string(name));
  std::erase_if(plain, [](char c) { return c == '_' || c == '-'; });
  return plain;
}

/// The cloud's own column of that name; an empty one where it has none.
QuantityColumn own_column(const Cloud& cloud, const std::string& name) {
  const auto* const own =
      std::ranges::find(own_columns, plain_name(name), [](const OwnColumn& column) { return plain_name(column.name); });
  if (own == own_columns.end()) return {};
  const double origin = own->axis < 0 ? 0 : cloud.origin[static_cast<std::size_t>(own->axis)];
  const std::vector<float>& column = cloud.*(own->column);
  QuantityColumn made{std::vector<double>(column.size()), origin == 0};
  std::ranges::transform(column, made.values.begin(), [origin](float value) { return value + origin; });
  return made;
}

[[noreturn]] void refuse_quantity(const Cloud& cloud, const std::string& wanted, const std::string& name,
                                  std::span<const std::string> fields) {
  std::vector<std::string> known(fields.begin(), fields.end());
  for (const OwnColumn& own : own_columns) {
    const bool told = std::ranges::any_of(
        fields, [&](const std::string& field) { return plain_name(field) == plain_name(own.name); });
    if (!told && !(cloud.*(own.column)).empty()) known.emplace_back(own.name);
  }
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: has no quantity '{}', but {}", name, wanted, fmt::join(known, ", ")));
}

}  // namespace

void mark_chosen(Cloud& cloud, const Condition& where, std::vector<QuantityColumn> of_file, const std::string& name,
                 std::span<const std::string> fields, bool may_lack) {
  if (cloud.size() == 0) return;
  of_file.resize(where.names.size());
  for (std::size_t i = 0; i < of_file.size(); ++i) {
    if (of_file[i].values.empty()) of_file[i] = own_column(cloud, where.names[i]);
    if (!of_file[i].values.empty()) continue;
    if (!may_lack) refuse_quantity(cloud, where.names[i], name, fields);
    of_file[i].values.assign(cloud.size(), std::numeric_limits<double>::quiet_NaN());
  }
  cloud.chosen = where_holds(where, of_file, cloud.size());
}

void keep_chosen(Cloud& cloud) {
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < cloud.chosen.size(); ++i)
    if (cloud.chosen[i] != 0) kept.push_back(static_cast<std::uint32_t>(i));
  if (!cloud.chosen.empty()) keep_rows(cloud, kept);
  cloud.chosen.clear();
}

SelectionCounts select_particles(Cloud& cloud, const Selection& selection, std::uint64_t first) {
  SelectionCounts counts;
  if (selection.centre && cloud.box_size > 0) wrap(cloud, *selection.centre);
  std::vector<std::uint32_t> kept;
  const bool all = keeps_all(cloud, selection);
  for (std::size_t i = 0; !all && i < cloud.size(); ++i) {
    if (!cloud.chosen.empty() && cloud.chosen[i] == 0) {
      ++counts.unchosen;
      continue;
    }
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
  if (!all) keep_rows(cloud, kept);
  cloud.chosen.clear();
  if (selection.every > 1) stand_for(cloud, selection.every);
  mend(cloud.density, counts);
  mend(cloud.temperature, counts);
  // Without a length a particle is a point.
  for (float& length : cloud.smoothing_length)
    length = length >= 0 && length <= std::numeric_limits<float>::max() ? length : 0;
  return counts;
}

}  // namespace wheatstone
