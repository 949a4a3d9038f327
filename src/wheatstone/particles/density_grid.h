#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// How dense particles lie: they are counted in the cells of a grid as they come, chunk by chunk, and need not be held.
/// The grid grows with them: its cells are the smallest power of two, in the cloud's units, of which `side` cover all
/// but a few that lie far out.
class DensityGrid {
 public:
  static constexpr int side = 128;

  void add(const Cloud& cloud) { add(cloud, {}); }
  /// Ranks add their chunks in step: the same cells come of it as where one adds the chunks of rank 0, 1, …
  void add(const Cloud& cloud, const Ranks& ranks);
  /// Adds up what the ranks have counted, at each of them.
  void share(const Ranks& ranks);
  /// To be called when all particles were added. Where a cell holds fewer than `particles_a_kernel`, its density
  /// follows from larger blocks of cells too.
  void finish(int particles_a_kernel = 32);

  /// Sets the particles' densities, in particles a unit of volume, and their smoothing lengths: the radius that holds
  /// as many particles as a kernel, as estimate_density does.
  void put_densities(Cloud& cloud) const;
  /// How log2 of the density, smoothed over two cells, changes over the radius of a kernel along each axis.
  std::array<float, 3> slope(float x, float y, float z) const;

 private:
  using Place = std::array<std::int64_t, 3>;
  /// Numbers of cells, the first along x first.
  static std::size_t index(int x, int y, int z) { return (static_cast<std::size_t>(z) * side + y) * side + x; }
  /// What of a chunk the grid is to cover.
  struct Region {
    std::array<float, 3> lower, upper;
  };
  /// What of a chunk decides the cells.
  struct Extent {
    std::uint64_t particles;
    std::array<double, 3> origin;
    Region region;
  };
  static Extent extent_of(const Cloud& cloud);
  static Region region_of(const Cloud& cloud);
  Place cell_of(const std::array<float, 3>& point) const;
  void take(const Extent& extent);
  void cover(const Region& region);
  void count(const Cloud& cloud);
  void fill_densities();
  /// Of the ball that holds the particles of a kernel where there is one in a unit of volume.
  double kernel_volume() const { return particles_a_kernel_ / (4 * std::numbers::pi / 3); }
  std::array<float, 3> in_cells(float x, float y, float z) const;

  double cell_ = 0;                 ///< its side's length; 0: nothing was added
  std::array<double, 3> origin_{};  ///< the clouds'
  Place first_{};                   ///< of the grid's cells, counted from the file's 0
  Place least_{}, most_{};
  std::uint64_t seen_ = 0;
  std::vector<std::uint32_t> counts_;
  double particles_a_kernel_ = 32;
  std::vector<float> log2_density_, smooth_;
};

}  // namespace wheatstone
