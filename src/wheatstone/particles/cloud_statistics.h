#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheatstone/particles/cloud.h"

namespace wheatstone {

/// How often which values occur, in steps of 1/16 of a factor of two; what is not positive or not finite is left out.
class LogHistogram {
 public:
  void add(const std::vector<float>& values);
  std::uint64_t total() const { return total_; }
  /// The value below which the share, 0..1, of all lies, to within a step; 0 where there is none.
  float percentile(double share) const;

 private:
  static constexpr int steps_a_factor_of_two = 16;
  std::array<std::uint64_t, std::size_t{256} * steps_a_factor_of_two> counts_{};
  std::uint64_t total_ = 0;
};

/// What must be known of all particles before the first is drawn: gathered chunk by chunk.
struct CloudStatistics {
  std::uint64_t count = 0;
  std::array<float, 3> lower{}, upper{};  ///< bounds of the positions
  LogHistogram density, temperature;
  bool has_density = false, has_temperature = false, has_colour = false, has_smoothing_length = false;

  void add(const Cloud& cloud);
  std::array<float, 3> centre() const;
  float radius() const;  ///< of the sphere around the bounds; not 0
};

}  // namespace wheatstone
