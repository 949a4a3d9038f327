#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

#include "wheatstone/particles/particle_rows_internal.h"
#include "wheatstone/particles/select.h"

namespace wheatstone {
namespace {

constexpr std::size_t looked_at = 1000;

/// One axis of the origin, for the first of a file's coordinates.
double origin_along(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  const double median = *middle;

  // Nine in ten tell how far they spread: a few that lie far out do not.
  for (double& value : values) value = std::abs(value - median);
  const auto most = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 9 / 10);
  std::ranges::nth_element(values, most);
  const double spread = *most > 0 ? *most : std::ranges::max(values);
  if (spread == 0) return static_cast<double>(static_cast<float>(median)) == median ? 0 : median;

  // Nearer to 0 than this, single precision loses four of its 24 bits at most.
  constexpr double near_enough = 16;
  return std::abs(median) > near_enough * spread ? median : 0;
}

/// The first of a file's coordinates along an axis.
std::vector<double> first_along(const ParticleRows& rows, std::size_t axis) {
  std::vector<double> first(std::min(looked_at, rows.size()));
  const std::array<const std::vector<double>*, 3> axes{&rows.x, &rows.y, &rows.z};
  for (std::size_t i = 0; i < first.size(); ++i)
    first[i] = !rows.single_points.empty() ? static_cast<double>(rows.single_points[3 * i + axis])
               : !rows.points.empty()      ? rows.points[3 * i + axis]
                                           : (*axes[axis])[i];
  return first;
}

std::array<double, 3> origin_of(const ParticleRows& rows) {
  return {origin_along(first_along(rows, 0)), origin_along(first_along(rows, 1)), origin_along(first_along(rows, 2))};
}

/// Coordinates along one axis as they lie in a file's rows.
template <class Number, std::size_t stride>
struct Coordinates {
  const Number* first;
  std::size_t count;
  Number operator[](std::size_t i) const { return first[i * stride]; }
};

/// Puts differences from the middle, computed as `Number`. False where not all of them are near: nearly always they
/// are, and then there is nothing to ask of each.
template <class Difference, class Number, std::size_t stride>
bool put_near(const Coordinates<Number, stride>& from, Difference middle, float* to) {
  std::conditional_t<sizeof(Difference) == 4, int, std::int64_t> all_near = 1;
  for (std::size_t i = 0; i < from.count; ++i) {
    const Difference value = static_cast<Difference>(from[i]) - middle;
    all_near &= std::abs(value) <= static_cast<Difference>(Cloud::farthest_drawn);
    to[i] = static_cast<float>(value);
  }
  return all_near != 0;
}

template <class Number, std::size_t stride>
void put_axis(const Coordinates<Number, stride>& from, double middle, std::vector<float>& to, double& farthest) {
  to.resize(from.count);
  if (middle == 0 ? put_near(from, Number{0}, to.data()) : put_near(from, middle, to.data())) return;
  for (std::size_t i = 0; i < from.count; ++i) {
    const double here = from[i];
    const double value = here - middle;
    to[i] = std::isfinite(value) ? in_single_precision(value) : static_cast<float>(value);
    if (std::abs(value) > Cloud::farthest_drawn && std::isfinite(here) && std::abs(here) > std::abs(farthest))
      farthest = here;
  }
}

template <class Number>
void put_points(const std::vector<Number>& points, Cloud& cloud) {
  const std::array<std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    put_axis(Coordinates<Number, 3>{points.data() + axis, points.size() / 3}, cloud.origin[axis], *axes[axis],
             cloud.farthest);
}

/// The rows as a cloud. What they leave is empty, but for the memory of their positions.
Cloud cloud_of(ParticleRows& rows, const std::array<double, 3>& origin) {
  Cloud cloud = std::move(rows.others);
  rows.others = {};
  cloud.origin = origin;
  if (!rows.single_points.empty()) {
    put_points(rows.single_points, cloud);
  } else if (!rows.points.empty()) {
    put_points(rows.points, cloud);
  } else {
    const auto put = [&](const std::vector<double>& from, double middle, std::vector<float>& to) {
      put_axis(Coordinates<double, 1>{from.data(), from.size()}, middle, to, cloud.farthest);
    };
    put(rows.x, origin[0], cloud.x);
    put(rows.y, origin[1], cloud.y);
    put(rows.z, origin[2], cloud.z);
  }
  for (std::vector<double>* column : {&rows.x, &rows.y, &rows.z, &rows.points}) column->clear();
  rows.single_points.clear();
  return cloud;
}

template <class Value>
std::vector<Value> taken(std::vector<Value>& from, std::size_t count) {
  const auto end = from.begin() + static_cast<std::ptrdiff_t>(std::min(count, from.size()));
  std::vector<Value> first(from.begin(), end);
  from.erase(from.begin(), end);
  return first;
}

/// The first rows, which are taken away.
ParticleRows taken(ParticleRows& from, std::size_t count) {
  ParticleRows rows{.x = taken(from.x, count),
                    .y = taken(from.y, count),
                    .z = taken(from.z, count),
                    .points = taken(from.points, 3 * count),
                    .single_points = taken(from.single_points, 3 * count)};
  for_each_column(rows.others, from.others, [&](auto& column, auto& rest) { column = taken(rest, count); });
  rows.others.box_size = from.others.box_size;
  for (QuantityColumn& column : from.named)
    rows.named.push_back({taken(column.values, count), column.single_precision});
  return rows;
}

/// Reads as the origin needs it, and gives as little as is asked for.
struct RowsInTurn {
  RowReader next;
  std::optional<std::array<double, 3>> origin;
  std::optional<Condition> where;
  bool where_may_lack;
  std::string path;
  std::vector<std::string> fields;
  ParticleRows rows = {};  ///< those that were read but not given yet; empty ones have memory
  Cloud used = {};         ///< given back, and empty but for its memory and its old positions

  void read_rows(std::size_t most) {
    rows.others = std::exchange(used, {});
    next(most, rows);
  }

  Cloud read(std::size_t most) {
    if (!origin) {
      read_rows(std::max(most, looked_at));
      origin = origin_of(rows);
    } else if (rows.size() == 0) {
      read_rows(most);
    }
    if (rows.size() <= most) return marked_cloud_of(rows);
    ParticleRows first = taken(rows, most);
    return marked_cloud_of(first);
  }

  Cloud marked_cloud_of(ParticleRows& some) const {
    std::vector<QuantityColumn> named = std::exchange(some.named, {});
    Cloud cloud = cloud_of(some, *origin);
    if (where) mark_chosen(cloud, *where, std::move(named), path, fields, where_may_lack);
    return cloud;
  }

  void reuse(Cloud cloud) {
    // Positions are overwritten: those that keep their length need not be filled with zeros first.
    std::apply([](auto& /*x*/, auto& /*y*/, auto& /*z*/, auto&... column) { (column.clear(), ...); },
               columns_of(cloud));
    cloud.farthest = cloud.box_size = 0;
    used = std::move(cloud);
  }
};

}  // namespace

void put_positions(std::vector<double> numbers, std::size_t width, ParticleRows& rows) {
  const std::size_t count = numbers.size() / width;
  for (std::size_t i = 1; width > 3 && i < count; ++i)
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i * width), 3,
                numbers.begin() + static_cast<std::ptrdiff_t>(i * 3));
  numbers.resize(3 * count);
  rows.points = std::move(numbers);
}

void give_rows(RowReader next, const std::filesystem::path& path, const CloudChoice& choice, CloudSource& source) {
  auto reading = std::make_shared<RowsInTurn>(RowsInTurn{.next = std::move(next),
                                                         .origin = choice.origin,
                                                         .where = choice.where,
                                                         .where_may_lack = choice.where_may_lack,
                                                         .path = path.string(),
                                                         .fields = source.fields});
  source.next = [reading](std::size_t most) { return reading->read(most); };
  source.reuse = [reading](Cloud used) { reading->reuse(std::move(used)); };
}

float in_single_precision(double value) {
  using Limits = std::numeric_limits<float>;
  if (value == 0 || !std::isfinite(value)) return static_cast<float>(value);
  const double size = std::clamp<double>(std::abs(value), Limits::min(), Limits::max());
  return static_cast<float>(std::copysign(size, value));
}

std::vector<float> in_single_precision(const std::vector<double>& values) {
  std::vector<float> single(values.size());
  std::ranges::transform(values, single.begin(), [](double value) { return in_single_precision(value); });
  return single;
}

}  // namespace wheatstone
