#include "wheatstone/particles/cloud_between.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/particles/select.h"

namespace wheatstone {
namespace {

constexpr std::size_t rows_a_task = 1 << 14;

template <class Value>
void reorder(std::vector<Value>& column, const std::vector<std::uint32_t>& order) {
  if (column.empty()) return;
  std::vector<Value> ordered(order.size());
  std::ranges::transform(order, ordered.begin(), [&](std::uint32_t row) { return column[row]; });
  column = std::move(ordered);
}

void order_by_id(Cloud& cloud, const std::filesystem::path& file) {
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order, [&](std::uint32_t a, std::uint32_t b) { return cloud.id[a] < cloud.id[b]; });
  std::apply([&](auto&... column) { (reorder(column, order), ...); }, columns_of(cloud));
  const auto twice = std::ranges::adjacent_find(cloud.id);
  if (twice != cloud.id.end())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has several particles with the ID {}, expected one, because particles are followed by "
                            "their IDs",
                            file.string(), *twice));
}

/// How far a time lies between two snapshots.
struct Moment {
  double share;     ///< 0 at the earlier, 1 at the later
  double duration;  ///< from the earlier to the later

  double eased() const { return share * share * (3 - 2 * share); }
};

/// One axis of two snapshots. Positions are relative to origins of their own.
struct Axis {
  const std::vector<float>&earlier, &later, &earlier_rate, &later_rate;
  double later_origin;  ///< relative to the earlier one's
  double first, box;    ///< where a periodic box begins, relative to the earlier origin, and its size; 0: none

  double nearest(double distance) const { return box > 0 ? distance - box * std::round(distance / box) : distance; }
  double wrapped(double position) const {
    return box > 0 ? position - box * std::floor((position - first) / box) : position;
  }
  static double rate(const std::vector<float>& rates, std::uint32_t row) {
    return rates.empty() ? 0. : static_cast<double>(rates[row]);
  }
};

float position_between(const Axis& axis, const std::array<std::uint32_t, 2>& rows, const Moment& moment) {
  const double from = axis.earlier[rows[0]];
  const double way = axis.nearest(axis.later[rows[1]] + axis.later_origin - from);
  const double t = moment.share;
  double moved = t * way;
  if (!axis.earlier_rate.empty() && !axis.later_rate.empty()) {
    // The cubic of Hermite, as its difference from the straight way.
    const double leaving = moment.duration * axis.earlier_rate[rows[0]] - way;
    const double arriving = moment.duration * axis.later_rate[rows[1]] - way;
    moved += t * (1 - t) * ((1 - t) * leaving - t * arriving);
  }
  return static_cast<float>(axis.wrapped(from + moved));
}

/// Between two values above 0, equal factors in equal times.
float value_between(float earlier, float later, double share) {
  if (!(earlier > 0 && later > 0)) return static_cast<float>(earlier + share * (static_cast<double>(later) - earlier));
  return static_cast<float>(earlier * std::pow(static_cast<double>(later) / earlier, share));
}

/// A column that both snapshots have. It is there for those particles, too, which one of them lacks.
template <class Value, class Between>
void put_column(const std::vector<Value>& earlier, const std::vector<Value>& later, const MatchedParticles& matched,
                std::vector<Value>& to, Between between) {
  const std::size_t both = matched.both.size(), gone = matched.only_earlier.size();
  // Of no particles every column is empty.
  if ((earlier.empty() && both + gone > 0) || (later.empty() && both + matched.only_later.size() > 0)) return;
  to.resize(both + gone + matched.only_later.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, both, rows_a_task), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      to[i] = between(earlier[matched.both[i][0]], later[matched.both[i][1]]);
  });
  for (std::size_t i = 0; i < gone; ++i) to[both + i] = earlier[matched.only_earlier[i]];
  for (std::size_t i = 0; i < matched.only_later.size(); ++i) to[both + gone + i] = later[matched.only_later[i]];
}

void put_positions(const Axis& axis, const MatchedParticles& matched, const Moment& moment, std::vector<float>& to) {
  const std::size_t both = matched.both.size(), gone = matched.only_earlier.size();
  to.resize(both + gone + matched.only_later.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, both, rows_a_task), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) to[i] = position_between(axis, matched.both[i], moment);
  });
  for (std::size_t i = 0; i < gone; ++i) {
    const std::uint32_t row = matched.only_earlier[i];
    const double moved = moment.share * moment.duration * Axis::rate(axis.earlier_rate, row);
    to[both + i] = static_cast<float>(axis.wrapped(axis.earlier[row] + moved));
  }
  for (std::size_t i = 0; i < matched.only_later.size(); ++i) {
    const std::uint32_t row = matched.only_later[i];
    const double moved = (moment.share - 1) * moment.duration * Axis::rate(axis.later_rate, row);
    to[both + gone + i] = static_cast<float>(axis.wrapped(axis.later[row] + axis.later_origin + moved));
  }
}

void put_presence(const MatchedParticles& matched, const Moment& moment, Cloud& cloud) {
  const std::size_t both = matched.both.size(), gone = matched.only_earlier.size();
  if (both == cloud.size()) return;
  const auto appeared = static_cast<float>(moment.eased());
  cloud.presence.resize(cloud.size(), 1.f);
  for (std::size_t i = both; i < cloud.size(); ++i) cloud.presence[i] *= i < both + gone ? 1 - appeared : appeared;
}

}  // namespace

TimedCloud read_timed_cloud(const std::filesystem::path& file, const CloudChoice& choice, const Progress& progress) {
  CloudChoice with_motion = choice;
  with_motion.motion = true;
  const CloudSource source = open_cloud(file, with_motion);
  TimedCloud timed;
  timed.cloud = read_cloud(source, file, progress);
  if (timed.cloud.id.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has no IDs that particles can be followed by, expected a GADGET HDF5 snapshot with "
                            "ParticleIDs",
                            file.string()));
  if (!source.time)
    throw Error(ErrorKind::bad_input, fmt::format("{}: its header tells no time, expected 'Time'", file.string()));
  timed.time = *source.time;
  keep_chosen(timed.cloud);
  order_by_id(timed.cloud, file);
  return timed;
}

MatchedParticles match_particles(const Cloud& earlier, const Cloud& later) {
  MatchedParticles matched;
  matched.both.reserve(std::min(earlier.size(), later.size()));
  std::uint32_t a = 0, b = 0;
  while (a < earlier.size() || b < later.size()) {
    if (b == later.size() || (a < earlier.size() && earlier.id[a] < later.id[b])) {
      matched.only_earlier.push_back(a++);
    } else if (a == earlier.size() || later.id[b] < earlier.id[a]) {
      matched.only_later.push_back(b++);
    } else {
      matched.both.push_back({a++, b++});
    }
  }
  return matched;
}

Cloud cloud_between(const TimedCloud& earlier, const TimedCloud& later, const MatchedParticles& matched, double time) {
  const Cloud &before = earlier.cloud, &after = later.cloud;
  const double duration = later.time - earlier.time;
  const Moment moment{duration > 0 ? std::clamp((time - earlier.time) / duration, 0., 1.) : 0., duration};
  Cloud cloud;
  cloud.origin = before.origin;
  cloud.box_size = before.box_size;
  cloud.farthest = std::abs(before.farthest) > std::abs(after.farthest) ? before.farthest : after.farthest;
  const auto axis = [&](std::size_t number, auto position, auto rate) {
    return Axis{before.*position,
                after.*position,
                before.*rate,
                after.*rate,
                after.origin[number] - before.origin[number],
                -before.origin[number],
                before.box_size};
  };
  put_positions(axis(0, &Cloud::x, &Cloud::rate_x), matched, moment, cloud.x);
  put_positions(axis(1, &Cloud::y, &Cloud::rate_y), matched, moment, cloud.y);
  put_positions(axis(2, &Cloud::z, &Cloud::rate_z), matched, moment, cloud.z);
  for (const auto column : {&Cloud::density, &Cloud::temperature, &Cloud::smoothing_length, &Cloud::mass,
                            &Cloud::quantity, &Cloud::presence})
    put_column(before.*column, after.*column, matched, cloud.*column,
               [&](float a, float b) { return value_between(a, b, moment.share); });
  put_column(before.colour, after.colour, matched, cloud.colour,
             [&](Rgb8 a, Rgb8 b) { return moment.share < 0.5 ? a : b; });
  put_presence(matched, moment, cloud);
  return cloud;
}

}  // namespace wheatstone
