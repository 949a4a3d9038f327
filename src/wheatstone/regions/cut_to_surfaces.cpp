#include "wheatstone/regions/cut_to_surfaces_internal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace wheatstone {
namespace {

/// The pixels of a part that lie off what its rows carry from edge to edge.
struct Misfit {
  double columns = 0, weights = 0;  ///< sums; each pixel counts by how far off it is
  std::int64_t area = 0;

  int middle() const { return static_cast<int>(std::ceil(columns / weights)); }
};

/// Adds the pixels of a row, from `begin` to before `end`, which are of one part.
void add_run(std::span<const float> row, int begin, int end, float tolerance_px, Misfit& misfit) {
  const float first = row[begin], slope = (row[end - 1] - first) / static_cast<float>(std::max(end - 1 - begin, 1));
  for (int x = begin + 1; x < end - 1; ++x) {
    const float off = std::abs(row[x] - first - slope * static_cast<float>(x - begin));
    if (!(off > tolerance_px)) continue;
    misfit.columns += static_cast<double>(x) * static_cast<double>(off);
    misfit.weights += static_cast<double>(off);
    ++misfit.area;
  }
}

std::vector<Misfit> misfits_of(const RegionMap& parts, ImageView<const float> disparity, float tolerance_px) {
  std::vector<Misfit> misfits(static_cast<std::size_t>(parts.count));
  for (int y = 0; y < disparity.height(); ++y) {
    const auto of = parts.of.row(y);
    for (int x = 0; x < disparity.width();) {
      const int begin = x;
      while (x < disparity.width() && of[x] == of[begin]) ++x;
      if (of[begin] >= 0)
        add_run(disparity.row(y), begin, x, tolerance_px, misfits[static_cast<std::size_t>(of[begin])]);
    }
  }
  return misfits;
}

/// Cuts once what does not fit; false where all do.
bool cut_once(ImageView<const float> disparity, float threshold_px, float tolerance_px, std::int64_t least_area,
              SurfaceParts& cut) {
  const std::vector<Misfit> misfits = misfits_of(cut.parts, disparity, tolerance_px);
  if (std::ranges::none_of(misfits, [&](const Misfit& m) { return m.area >= least_area; })) return false;
  Image<std::int32_t> labels(disparity.width(), disparity.height(), -1);
  for (int y = 0; y < disparity.height(); ++y) {
    for (int x = 0; x < disparity.width(); ++x) {
      const std::int32_t part = cut.parts.of(x, y);
      if (part < 0) continue;
      const Misfit& misfit = misfits[static_cast<std::size_t>(part)];
      labels(x, y) = 2 * part + (misfit.area >= least_area && x >= misfit.middle() ? 1 : 0);
    }
  }
  RegionMap parts = connected_regions(labels, disparity, threshold_px);
  std::vector<std::int32_t> region(static_cast<std::size_t>(parts.count));
  for (std::size_t i = 0; i < labels.pixels().size(); ++i)
    if (parts.of.pixels()[i] >= 0)
      region[static_cast<std::size_t>(parts.of.pixels()[i])] =
          cut.region[static_cast<std::size_t>(labels.pixels()[i] / 2)];
  cut = {std::move(parts), std::move(region)};
  return true;
}

}  // namespace

SurfaceParts cut_to_surfaces(const RegionMap& regions, ImageView<const float> disparity, float threshold_px,
                             float tolerance_px, std::int64_t least_area) {
  SurfaceParts cut{regions, std::vector<std::int32_t>(static_cast<std::size_t>(regions.count))};
  std::iota(cut.region.begin(), cut.region.end(), 0);
  constexpr int most_rounds = 8;  // each halves what does not fit
  for (int round = 0; round < most_rounds; ++round)
    if (!cut_once(disparity, threshold_px, tolerance_px, least_area, cut)) break;
  return cut;
}

}  // namespace wheatstone
