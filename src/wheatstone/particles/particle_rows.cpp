#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "wheatstone/particles/particle_rows_internal.h"

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

std::array<double, 3> origin_of(const ParticleRows& rows) {
  const auto first = [](const std::vector<double>& axis) {
    return std::vector<double>(axis.begin(),
                               axis.begin() + static_cast<std::ptrdiff_t>(std::min(looked_at, axis.size())));
  };
  return {origin_along(first(rows.x)), origin_along(first(rows.y)), origin_along(first(rows.z))};
}

Cloud cloud_of(ParticleRows rows, const std::array<double, 3>& origin) {
  Cloud cloud = std::move(rows.others);
  cloud.origin = origin;
  const auto put = [&](const std::vector<double>& from, double middle, std::vector<float>& to) {
    to.resize(from.size());
    // Nearly always all of them lie near: then there is nothing to ask of each.
    bool all_near = true;
    for (const double value : from) all_near &= std::abs(value - middle) <= Cloud::farthest_drawn;
    if (all_near) {
      std::ranges::transform(from, to.begin(), [middle](double value) { return static_cast<float>(value - middle); });
      return;
    }
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double value = from[i] - middle;
      to[i] = std::isfinite(value) ? in_single_precision(value) : static_cast<float>(value);
      if (std::abs(value) > Cloud::farthest_drawn && std::isfinite(from[i]) &&
          std::abs(from[i]) > std::abs(cloud.farthest))
        cloud.farthest = from[i];
    }
  };
  put(rows.x, origin[0], cloud.x);
  put(rows.y, origin[1], cloud.y);
  put(rows.z, origin[2], cloud.z);
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
  ParticleRows rows{.x = taken(from.x, count), .y = taken(from.y, count), .z = taken(from.z, count)};
  for_each_column(rows.others, from.others, [&](auto& column, auto& rest) { column = taken(rest, count); });
  rows.others.box_size = from.others.box_size;
  return rows;
}

/// Reads as the origin needs it, and gives as little as is asked for.
struct Reading {
  RowReader next;
  std::optional<std::array<double, 3>> origin;
  ParticleRows waiting;

  Cloud read(std::size_t most) {
    if (waiting.size() == 0) {
      if (origin) return cloud_of(next(most), *origin);
      waiting = next(std::max(most, looked_at));
      origin = origin_of(waiting);
    }
    if (waiting.size() <= most) return cloud_of(std::exchange(waiting, {}), *origin);
    return cloud_of(taken(waiting, most), *origin);
  }
};

}  // namespace

void put_positions(const std::vector<double>& numbers, std::size_t width, ParticleRows& rows) {
  const std::size_t count = numbers.size() / width;
  rows.x.resize(count);
  rows.y.resize(count);
  rows.z.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    rows.x[i] = numbers[i * width];
    rows.y[i] = numbers[i * width + 1];
    rows.z[i] = numbers[i * width + 2];
  }
}

std::function<Cloud(std::size_t most)> cloud_reader(RowReader next, std::optional<std::array<double, 3>> origin) {
  auto reading = std::make_shared<Reading>(Reading{.next = std::move(next), .origin = origin, .waiting = {}});
  return [reading](std::size_t most) { return reading->read(most); };
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
