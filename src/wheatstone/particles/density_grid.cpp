#include "wheatstone/particles/density_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <utility>

namespace wheatstone {

DensityGrid::Place DensityGrid::cell_of(const std::array<float, 3>& point) const {
  Place place;
  for (std::size_t axis = 0; axis < 3; ++axis)
    place[axis] = static_cast<std::int64_t>(std::floor((origin_[axis] + static_cast<double>(point[axis])) / cell_));
  return place;
}

/// The bounds, but for what lies farther from the middle 99.8 % than half of their extent.
DensityGrid::Region DensityGrid::region_of(const Cloud& cloud) {
  constexpr std::size_t enough = 4096;
  const std::size_t every = (cloud.size() + enough - 1) / enough;
  Region region;
  const std::array<const std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::ranges::minmax(*axes[axis]);
    std::vector<float> some;
    for (std::size_t i = 0; i < cloud.size(); i += every) some.push_back((*axes[axis])[i]);
    const std::size_t ends = some.size() < 20 ? 0 : some.size() / 1000 + 1;
    const auto first = some.begin() + static_cast<std::ptrdiff_t>(ends);
    const auto last = some.end() - 1 - static_cast<std::ptrdiff_t>(ends);
    std::ranges::nth_element(some, first);
    const float lower = *first;
    std::ranges::nth_element(some, last);
    const float margin = (*last - lower) / 2;
    region.lower[axis] = std::max(least, lower - margin);
    region.upper[axis] = std::min(most, *last + margin);
  }
  return region;
}

/// Makes cells as large as it takes to cover the region too, and counts again what was counted.
void DensityGrid::cover(const Region& region) {
  const auto& [lower, upper] = region;
  if (cell_ == 0) {
    double extent = std::numeric_limits<float>::min();
    for (std::size_t axis = 0; axis < 3; ++axis)
      extent = std::max({extent, static_cast<double>(upper[axis]) - lower[axis], std::abs(lower[axis]) * 1e-6,
                         std::abs(origin_[axis]) * 1e-12});
    cell_ = std::exp2(std::ceil(std::log2(extent / side)));
    least_ = first_ = cell_of(lower);
    most_ = cell_of(upper);
    counts_.assign(static_cast<std::size_t>(side) * side * side, 0);
  }
  const Place lower_cell = cell_of(lower);
  const Place upper_cell = cell_of(upper);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least_[axis] = std::min(least_[axis], lower_cell[axis]);
    most_[axis] = std::max(most_[axis], upper_cell[axis]);
  }
  int halvings = 0;
  const auto fits = [&](std::size_t axis) { return (most_[axis] >> halvings) - (least_[axis] >> halvings) < side; };
  while (!fits(0) || !fits(1) || !fits(2)) ++halvings;
  const Place before = std::exchange(first_, {least_[0] >> halvings, least_[1] >> halvings, least_[2] >> halvings});
  if (halvings == 0 && before == first_) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least_[axis] >>= halvings;
    most_[axis] >>= halvings;
  }
  cell_ = std::ldexp(cell_, halvings);
  const std::vector<std::uint32_t> counted = std::exchange(counts_, std::vector<std::uint32_t>(counts_.size()));
  const auto moved = [&](int at, std::size_t axis) {
    return static_cast<int>(((before[axis] + at) >> halvings) - first_[axis]);
  };
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (const std::uint32_t count = counted[index(x, y, z)]; count > 0)
          counts_[index(moved(x, 0), moved(y, 1), moved(z, 2))] += count;
}

DensityGrid::Extent DensityGrid::extent_of(const Cloud& cloud) {
  if (cloud.size() == 0) return {};
  return {cloud.size(), cloud.origin, region_of(cloud)};
}

void DensityGrid::take(const Extent& extent) {
  origin_ = extent.origin;
  // A few beside all that were seen do not decide how large the cells are.
  constexpr std::uint64_t few = 1000;
  if (extent.particles * few > seen_) cover(extent.region);
  seen_ += extent.particles;
}

void DensityGrid::count(const Cloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Place place = cell_of({cloud.x[i], cloud.y[i], cloud.z[i]});
    const std::int64_t x = place[0] - first_[0];
    const std::int64_t y = place[1] - first_[1];
    const std::int64_t z = place[2] - first_[2];
    const bool inside = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < side;
    if (inside) ++counts_[index(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z))];
  }
}

// The grid of each rank grows with all chunks, and holds the counts of its own.
void DensityGrid::add(const Cloud& cloud, const Ranks& ranks) {
  const std::vector<Extent> extents = ranks.from_all(extent_of(cloud));
  for (int rank = 0; rank < ranks.count(); ++rank) {
    const Extent& extent = extents[static_cast<std::size_t>(rank)];
    if (extent.particles == 0) continue;
    take(extent);
    if (rank == ranks.rank()) count(cloud);
  }
}

void DensityGrid::share(const Ranks& ranks) {
  if (ranks.alone() || cell_ == 0) return;
  // Each rank adds up its part of the cells: no one holds the counts of all.
  const auto all = static_cast<std::size_t>(ranks.count());
  std::vector<Ranks::Bytes> parts(all);
  for (std::size_t rank = 0; rank < all; ++rank) {
    const std::size_t first = counts_.size() * rank / all;
    parts[rank] = Ranks::bytes_of(
        std::span<const std::uint32_t>(counts_).subspan(first, counts_.size() * (rank + 1) / all - first));
  }
  const RankPart mine = part_of(ranks, counts_.size());
  std::vector<std::uint32_t> sums(mine.end - mine.first), counted(sums.size());
  for (const Ranks::Bytes& of_rank : ranks.exchange(parts)) {
    std::memcpy(counted.data(), of_rank.data(), of_rank.size());
    std::ranges::transform(sums, counted, sums.begin(), std::plus<>());
  }
  std::byte* to = std::as_writable_bytes(std::span(counts_)).data();
  for (const Ranks::Bytes& of_rank : ranks.from_all(Ranks::bytes_of(std::span<const std::uint32_t>(sums))))
    to = std::ranges::copy(of_rank, to).out;
}

namespace {

/// Counts in blocks of twice the size.
std::vector<std::uint32_t> joined(const std::vector<std::uint32_t>& counts, int blocks) {
  const int half = blocks / 2;
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(half) * half * half);
  for (int z = 0; z < blocks; ++z)
    for (int y = 0; y < blocks; ++y)
      for (int x = 0; x < blocks; ++x)
        sums[(static_cast<std::size_t>(z / 2) * half + y / 2) * half + x / 2] +=
            counts[(static_cast<std::size_t>(z) * blocks + y) * blocks + x];
  return sums;
}

/// Between the middles of so many cells a side; beyond the outermost middles, as there.
float interpolated(const std::vector<float>& values, int cells, const std::array<float, 3>& in_cells) {
  std::array<int, 3> near;
  std::array<int, 3> far;
  std::array<float, 3> share;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float at = std::clamp(in_cells[axis], 0.f, static_cast<float>(cells - 1));
    near[axis] = static_cast<int>(at);
    far[axis] = std::min(near[axis] + 1, cells - 1);
    share[axis] = at - static_cast<float>(near[axis]);
  }
  const auto between = [](float from, float to, float part) { return from + part * (to - from); };
  const auto along_x = [&](int y, int z) {
    const float* const row = values.data() + (static_cast<std::size_t>(z) * cells + y) * cells;
    return between(row[near[0]], row[far[0]], share[0]);
  };
  const auto in_plane = [&](int z) { return between(along_x(near[1], z), along_x(far[1], z), share[1]); };
  return between(in_plane(near[2]), in_plane(far[2]), share[2]);
}

}  // namespace

/// From the whole grid to its cells: each block of cells has the density that its own count tells, as far as it is full
/// enough, else that of the blocks of twice its size around it.
void DensityGrid::fill_densities() {
  std::vector<std::vector<std::uint32_t>> sums{std::move(counts_)};
  for (int blocks = side / 2; blocks > 0; blocks /= 2) sums.push_back(joined(sums.back(), 2 * blocks));
  std::vector<float> wider{0.f};
  for (int level = static_cast<int>(sums.size()) - 1; level >= 0; --level) {
    const std::vector<std::uint32_t>& counts = sums[static_cast<std::size_t>(level)];
    const int blocks = side >> level;
    const double volume = std::pow(std::ldexp(cell_, level), 3);
    std::vector<float> density(counts.size());
    tbb::parallel_for(0, blocks, [&](int z) {
      for (int y = 0; y < blocks; ++y)
        for (int x = 0; x < blocks; ++x) {
          const std::size_t at = (static_cast<std::size_t>(z) * blocks + y) * blocks + x;
          const double full = blocks == 1 ? 1 : std::min(counts[at] / static_cast<double>(particles_a_kernel_), 1.);
          const auto in_wider = [](int place) { return (static_cast<float>(place) - 0.5f) / 2; };
          const double around = full < 1 ? interpolated(wider, blocks / 2, {in_wider(x), in_wider(y), in_wider(z)}) : 0;
          const double own = full > 0 ? std::log2(counts[at] / volume) : 0;
          density[at] = static_cast<float>(full * own + (1 - full) * around);
        }
    });
    wider = std::move(density);
  }
  log2_density_ = std::move(wider);
}

namespace {

/// Spreads a line of values over their neighbours, a quarter to either side; values beyond the ends are as at them.
void blur_line(float* first, std::size_t side) {
  float before = first[0];
  for (std::size_t i = 0; i < side; ++i) {
    const float here = first[i], after = first[std::min(i + 1, side - 1)];
    first[i] = (before + 2 * here + after) / 4;
    before = here;
  }
}

/// The same along another axis, of `side` lines that lie side by side: they begin at `first`, and their values are
/// `stride` apart.
void blur_lines(float* first, std::size_t stride, std::size_t side) {
  std::vector<float> before(first, first + side);
  for (std::size_t i = 0; i < side; ++i) {
    float* const here = first + i * stride;
    const float* const after = first + std::min(i + 1, side - 1) * stride;
    for (std::size_t line = 0; line < side; ++line) {
      const float value = here[line];
      here[line] = (before[line] + 2 * value + after[line]) / 4;
      before[line] = value;
    }
  }
}

/// Blurs a cube of values along its three axes.
void blur(std::vector<float>& values, std::size_t side) {
  float* const first = values.data();
  const std::size_t plane = side * side;
  tbb::parallel_for(std::size_t{0}, side, [&](std::size_t z) {
    for (std::size_t y = 0; y < side; ++y) blur_line(first + z * plane + y * side, side);
    blur_lines(first + z * plane, side, side);
  });
  tbb::parallel_for(std::size_t{0}, side, [&](std::size_t y) { blur_lines(first + y * side, plane, side); });
}

}  // namespace

void DensityGrid::finish(int particles_a_kernel) {
  if (cell_ == 0) return;
  particles_a_kernel_ = particles_a_kernel;
  fill_densities();
  smooth_ = log2_density_;
  for (int times = 0; times < 2; ++times) blur(smooth_, side);
}

std::array<float, 3> DensityGrid::in_cells(float x, float y, float z) const {
  const std::array<float, 3> point{x, y, z};
  std::array<float, 3> at;
  for (std::size_t axis = 0; axis < 3; ++axis)
    at[axis] = static_cast<float>((origin_[axis] + static_cast<double>(point[axis])) / cell_ -
                                  static_cast<double>(first_[axis]) - 0.5);
  return at;
}

void DensityGrid::put_densities(Cloud& cloud) const {
  cloud.density.resize(cloud.size());
  cloud.smoothing_length.resize(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const double density = std::exp2(
          static_cast<double>(interpolated(log2_density_, side, in_cells(cloud.x[i], cloud.y[i], cloud.z[i]))));
      cloud.density[i] = static_cast<float>(std::clamp(density, 1e-37, 1e37));
      cloud.smoothing_length[i] = static_cast<float>(std::cbrt(kernel_volume() / density));
    }
  });
}

std::array<float, 3> DensityGrid::slope(float x, float y, float z) const {
  const std::array<float, 3> at = in_cells(x, y, z);
  const double density = std::exp2(static_cast<double>(interpolated(smooth_, side, at)));
  const auto radius_in_cells = static_cast<float>(std::cbrt(kernel_volume() / density) / cell_);
  std::array<float, 3> slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, 3> before = at;
    std::array<float, 3> after = at;
    before[axis] -= 1;
    after[axis] += 1;
    slope[axis] = (interpolated(smooth_, side, after) - interpolated(smooth_, side, before)) / 2 * radius_in_cells;
  }
  return slope;
}

}  // namespace wheatstone
