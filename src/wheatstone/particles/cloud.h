#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Particles as a structure of arrays, in the units of their file. x, y and z are as long as the cloud; every other
/// column is as long, or empty where the file does not have it.
struct Cloud {
  std::vector<float> x, y, z;
  std::vector<float> density;
  std::vector<float> temperature;  ///< kelvin in snapshots; any other scalar where the user names one
  std::vector<float> smoothing_length;
  std::vector<float> mass;      ///< where there is none, each particle counts 1
  std::vector<float> quantity;  ///< what the user named to be shown (CloudChoice::quantity)
  std::vector<Rgb8> colour;
  /// Share of its light that a particle gives, where it fades, or how many particles it stands for; empty: 1.
  std::vector<float> presence;
  std::vector<std::uint8_t> chosen;  ///< 1 where CloudChoice::where holds, else 0; empty: 1
  std::vector<std::uint64_t> id;     ///< in a simulation; only where motion was asked for
  /// Changes of x, y and z in a unit of the snapshot's time; only where motion was asked for.
  std::vector<float> rate_x, rate_y, rate_z;
  /// Taken off every position in double precision when it was read, so that single precision suffices far from 0: an
  /// easting of 4 500 000 m. The same in all chunks of a file.
  std::array<double, 3> origin{};
  /// The largest coordinate of the file that lies farther from the origin than `farthest_drawn`; 0 where none does.
  double farthest = 0;
  double box_size = 0;  ///< of a periodic box [0, box_size)³; 0 where there is none

  /// Distances are computed in single precision: their squares must not overflow.
  static constexpr float farthest_drawn = 1e18f;

  std::size_t size() const { return x.size(); }
};

/// Every column of a cloud, for all that works on whole particles: a tuple of references.
template <class AnyCloud>
auto columns_of(AnyCloud& cloud) {
  return std::tie(cloud.x, cloud.y, cloud.z, cloud.density, cloud.temperature, cloud.smoothing_length, cloud.colour,
                  cloud.mass, cloud.quantity, cloud.presence, cloud.chosen, cloud.id, cloud.rate_x, cloud.rate_y,
                  cloud.rate_z);
}

/// Calls `visit` with each column of one cloud and the same one of another.
template <class To, class From, class Visit>
void for_each_column(To& to, From& from, Visit visit) {
  const auto to_columns = columns_of(to);
  const auto from_columns = columns_of(from);
  [&]<std::size_t... column>(std::index_sequence<column...>) {
    (visit(std::get<column>(to_columns), std::get<column>(from_columns)), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(columns_of(to))>>());
}

}  // namespace wheatstone
