#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/particles/density_grid.h"
#include "wheatstone/particles/framed_region.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// How often which values occur, in steps of 1/16 of a factor of two; what is not positive or not finite is left out.
class LogHistogram {
 public:
  void add(const std::vector<float>& values);
  void add(const LogHistogram& other);
  std::uint64_t total() const { return total_; }
  /// The value below which the share, 0..1, of all lies, to within a step; 0 where there is none.
  float percentile(double share) const;
  /// The sum of 1 over each value, to within a step.
  double sum_of_inverses() const;

 private:
  static constexpr std::size_t steps = std::size_t{256} * 16;
  std::array<std::uint64_t, steps> counts_{};
  std::uint64_t total_ = 0;
};

/// Some of the particles, the same however they come in chunks or to ranks: all, as long as they are few.
class ParticleSample {
 public:
  /// Particles of which so many came before, here or at other ranks.
  void add(const Cloud& cloud, std::uint64_t before);
  const Cloud& cloud() const { return kept_; }
  Cloud& cloud() { return kept_; }
  /// That of all ranks' particles, at each of them.
  void share(const Ranks& ranks);

 private:
  void thin_out();
  std::vector<std::uint64_t> numbers_;  ///< of the kept ones, among all
  Cloud kept_;
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

  /// Of a grid that is finished: densities and smoothing lengths are those that it tells.
  void take_densities_of_grid();
  void add(const Cloud& cloud) { add(cloud, count); }
  /// Particles of which so many came before, here or at other ranks.
  void add(const Cloud& cloud, std::uint64_t before);
  /// Makes those of the particles that each rank was given those of all, at each rank. Only the masses are not added
  /// up: sums depend on their order.
  void share(const Ranks& ranks);
  /// Of what the views are framed by; the radius is not 0.
  std::array<float, 3> centre() const;
  float radius() const;
};

}  // namespace wheatstone
