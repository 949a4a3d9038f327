#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/particles/density_grid.h"
#include "wheatstone/particles/framed_region.h"

namespace wheatstone {

/// How often which values occur, in steps of 1/16 of a factor of two; what is not positive or not finite is left out.
class LogHistogram {
 public:
  void add(const std::vector<float>& values);
  std::uint64_t total() const { return total_; }
  /// The value below which the share, 0..1, of all lies, to within a step; 0 where there is none.
  float percentile(double share) const;
  /// The sum of 1 over each value, to within a step.
  double sum_of_inverses() const;

 private:
  static constexpr int steps_a_factor_of_two = 16;
  std::array<std::uint64_t, std::size_t{256} * steps_a_factor_of_two> counts_{};
  std::uint64_t total_ = 0;
};

/// Some of the particles, the same however they come in chunks: all, as long as they are few.
class ParticleSample {
 public:
  void add(const Cloud& cloud);
  const Cloud& cloud() const { return kept_; }
  Cloud& cloud() { return kept_; }

 private:
  std::vector<std::uint32_t> keys_;
  Cloud kept_;
  std::uint64_t seen_ = 0;
  std::uint32_t highest_key_ = 0xFFFFFFFF;
};

/// What must be known of all particles before the first is drawn: gathered chunk by chunk.
struct CloudStatistics {
  std::uint64_t count = 0;
  std::array<double, 3> origin{};         ///< the cloud's
  std::array<float, 3> lower{}, upper{};  ///< bounds of the positions
  ParticleSample sample;
  std::shared_ptr<DensityGrid> grid;   ///< counts the particles too, where it is wanted
  std::optional<FramedRegion> framed;  ///< what the views are framed by; nothing: by the bounds
  LogHistogram density, temperature;
  double mass = 0;             ///< of all
  float largest_quantity = 0;  ///< magnitude of what the user names
  bool has_density = false, has_temperature = false, has_colour = false, has_smoothing_length = false, has_mass = false;

  void add(const Cloud& cloud);
  /// Of a grid that is finished: densities and smoothing lengths are those that it tells.
  void take_densities_of_grid();
  /// Of what the views are framed by; the radius is not 0.
  std::array<float, 3> centre() const;
  float radius() const;
};

}  // namespace wheatstone
