#include "wheatstone/particles/sph_density.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <nanoflann.hpp>
#include <numbers>

namespace wheatstone {
namespace {

/// What nanoflann asks of a cloud; in a periodic box, of the cloud and of its images near the box's sides.
struct Points {
  std::vector<std::array<float, 3>> at;
  std::size_t kdtree_get_point_count() const { return at.size(); }
  float kdtree_get_pt(std::size_t index, std::size_t axis) const { return at[index][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3>;

/// Cubic spline of radius 2h, at the distance of `ratio` times 2h, for 2h = 1 (Monaghan 1992).
double kernel(double ratio) {
  constexpr double factor = 8 / std::numbers::pi;
  if (ratio < 0.5) return factor * (1 + 6 * ratio * ratio * (ratio - 1));
  return ratio < 1 ? factor * 2 * std::pow(1 - ratio, 3) : 0;
}

/// The images, in a periodic box, of particles within `reach` of its sides.
void add_images(const Cloud& cloud, float reach, Points& points) {
  const auto box = static_cast<float>(cloud.box_size);
  std::array<float, 3> lower;  // the box's corner, as the positions are
  for (std::size_t axis = 0; axis < 3; ++axis) lower[axis] = static_cast<float>(-cloud.origin[axis]);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::array<float, 3> at{cloud.x[i], cloud.y[i], cloud.z[i]};
    for (int image = 1; image < 27; ++image) {
      std::array<float, 3> moved = at;
      bool wanted = true;
      for (int axis = 0, rest = image; axis < 3; ++axis, rest /= 3) {
        if (rest % 3 == 1) {
          wanted = wanted && at[axis] - lower[axis] < reach;
          moved[axis] += box;
        } else if (rest % 3 == 2) {
          wanted = wanted && at[axis] - lower[axis] > box - reach;
          moved[axis] -= box;
        }
      }
      if (wanted) points.at.push_back(moved);
    }
  }
}

Points points_of(const Cloud& cloud, std::size_t neighbours) {
  Points points;
  for (std::size_t i = 0; i < cloud.size(); ++i) points.at.push_back({cloud.x[i], cloud.y[i], cloud.z[i]});
  if (cloud.box_size > 0) {
    // Thin places reach farther than the mean distance: three times holds what matters of them.
    const double spacing =
        cloud.box_size / std::cbrt(static_cast<double>(cloud.size()) / static_cast<double>(neighbours));
    add_images(cloud, static_cast<float>(std::min(3 * spacing, cloud.box_size / 2)), points);
  }
  return points;
}

/// Each rank has made its part of a column: gives all of it to each.
void share(std::vector<float>& column, const RankPart& mine, const Ranks& ranks) {
  if (ranks.alone()) return;
  const auto part = std::span<const float>(column).subspan(mine.first, mine.end - mine.first);
  std::size_t at = 0;
  for (const Ranks::Bytes& bytes : ranks.from_all(Ranks::bytes_of(part))) {
    std::memcpy(column.data() + at, bytes.data(), bytes.size());
    at += bytes.size() / sizeof(float);
  }
}

}  // namespace

void estimate_density(Cloud& cloud, int neighbours, const Progress& progress, const Ranks& ranks) {
  if (cloud.size() == 0) return;
  const std::size_t wanted = std::clamp<std::size_t>(static_cast<std::size_t>(neighbours), 1, cloud.size());
  const Points points = points_of(cloud, wanted);
  report(progress, "density", 0);
  const Tree tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  cloud.density.assign(cloud.size(), 0.f);
  cloud.smoothing_length.assign(cloud.size(), 0.f);

  // Where all neighbours lie in one place the volume is not 0, but that of the smallest length the position can tell.
  const auto least_reach = [](const std::array<float, 3>& at) {
    const float largest = std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
    return std::max(static_cast<double>(largest) * 1e-6, 1e-12);
  };

  constexpr std::size_t at_a_time = 1 << 18;
  const RankPart mine = part_of(ranks, cloud.size());
  for (std::size_t begin = mine.first; begin < mine.end; begin += at_a_time) {
    report(progress, "density", static_cast<double>(begin - mine.first) / static_cast<double>(mine.end - mine.first));
    const std::size_t end = std::min(begin + at_a_time, mine.end);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 512), [&](const auto& range) {
      std::vector<std::uint32_t> found(wanted);
      std::vector<float> squares(wanted);
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::size_t count = tree.knnSearch(points.at[i].data(), wanted, found.data(), squares.data());
        const double reach = std::max(std::sqrt(static_cast<double>(squares[count - 1])), least_reach(points.at[i]));
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += kernel(std::sqrt(static_cast<double>(squares[k])) / reach);
        cloud.density[i] = static_cast<float>(std::min(sum / (reach * reach * reach), 1e37));
        cloud.smoothing_length[i] = static_cast<float>(reach);
      }
    });
  }
  for (std::vector<float>* const column : {&cloud.density, &cloud.smoothing_length}) share(*column, mine, ranks);
  report(progress, "density", 1);
}

}  // namespace wheatstone
