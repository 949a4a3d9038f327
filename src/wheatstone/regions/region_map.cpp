#include <cmath>
#include <limits>
#include <numeric>

#include "wheatstone/marks/residual.h"
#include "wheatstone/regions/region_map_internal.h"

namespace wheatstone {
namespace {

/// Sets that are joined; the least member stands for each.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t find(std::int32_t i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
  std::vector<std::int32_t> parent_;
};

/// Calls `visit(x, y, nx, ny)` for every pixel and its neighbours to the right and below on the same surface.
template <class Visit>
void for_each_neighbours(ImageView<const float> disparity, float threshold_px, Visit visit) {
  for (int y = 0; y < disparity.height(); ++y) {
    for (int x = 0; x < disparity.width(); ++x) {
      const float own = disparity(x, y);
      if (x + 1 < disparity.width() && std::abs(disparity(x + 1, y) - own) <= threshold_px) visit(x, y, x + 1, y);
      if (y + 1 < disparity.height() && std::abs(disparity(x, y + 1) - own) <= threshold_px) visit(x, y, x, y + 1);
    }
  }
}

/// Numbers regions in the order in which they first appear; `set_of` maps a pixel's index and value to its set or −1.
template <class SetOf>
RegionMap numbered(int width, int height, std::size_t most_sets, SetOf set_of) {
  RegionMap regions{Image<std::int32_t>(width, height, -1), 0};
  std::vector<std::int32_t> numbers(most_sets, -1);
  std::int32_t index = 0;
  for (std::int32_t& region : regions.of.pixels()) {
    const std::int32_t set = set_of(index++);
    if (set < 0) continue;
    std::int32_t& number = numbers[static_cast<std::size_t>(set)];
    if (number < 0) number = regions.count++;
    region = number;
  }
  return regions;
}

double squared_distance(const RegionMeans& a, const RegionMeans& b) {
  const double red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
  return red * red + green * green + blue * blue;
}

struct Neighbour {
  double distance = std::numeric_limits<double>::infinity();
  std::int32_t region = -1;

  void offer(double other_distance, std::int32_t other) {
    if (other_distance < distance || (other_distance == distance && other < region)) {
      distance = other_distance;
      region = other;
    }
  }
};

}  // namespace

RegionMap connected_regions(ImageView<const std::int32_t> labels, ImageView<const float> disparity,
                            float threshold_px) {
  const int width = labels.width();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(labels.height());
  Sets sets(pixels);
  for_each_neighbours(disparity, threshold_px, [&](int x, int y, int nx, int ny) {
    if (labels(x, y) >= 0 && labels(x, y) == labels(nx, ny)) sets.join(y * width + x, ny * width + nx);
  });
  return numbered(width, labels.height(), pixels,
                  [&](std::int32_t index) { return labels(index % width, index / width) < 0 ? -1 : sets.find(index); });
}

Rgb8 mean_colour(const RegionMeans& means) {
  const auto level = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {level(means.red), level(means.green), level(means.blue)};
}

std::vector<RegionMeans> means_of(const RegionMap& regions, ImageView<const Rgb8> photograph,
                                  ImageView<const float> disparity) {
  std::vector<RegionMeans> means(static_cast<std::size_t>(regions.count));
  for (int y = 0; y < photograph.height(); ++y) {
    for (int x = 0; x < photograph.width(); ++x) {
      if (regions.of(x, y) < 0) continue;
      RegionMeans& mean = means[static_cast<std::size_t>(regions.of(x, y))];
      const Rgb8 colour = photograph(x, y);
      mean.red += colour.r;
      mean.green += colour.g;
      mean.blue += colour.b;
      mean.disparity += static_cast<double>(disparity(x, y));
      ++mean.area;
    }
  }
  for (RegionMeans& mean : means) {
    const auto area = static_cast<double>(mean.area);
    mean.red /= area;
    mean.green /= area;
    mean.blue /= area;
    mean.disparity /= area;
  }
  return means;
}

RegionMap without_small_regions(RegionMap regions, ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                                float threshold_px, std::int64_t least_area) {
  // Specks join specks, and become large enough or are joined on: a few rounds do.
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<RegionMeans> means = means_of(regions, photograph, disparity);
    std::vector<Neighbour> nearest(means.size());
    const auto offer = [&](std::int32_t small, std::int32_t other) {
      const RegionMeans& mean = means[static_cast<std::size_t>(small)];
      if (mean.area < least_area)
        nearest[static_cast<std::size_t>(small)].offer(squared_distance(mean, means[static_cast<std::size_t>(other)]),
                                                       other);
    };
    for_each_neighbours(disparity, threshold_px, [&](int x, int y, int nx, int ny) {
      const std::int32_t a = regions.of(x, y), b = regions.of(nx, ny);
      if (a < 0 || b < 0 || a == b) return;
      offer(a, b);
      offer(b, a);
    });
    Sets sets(means.size());
    bool joined = false;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (nearest[i].region < 0) continue;
      // Something small whose colour is like none about it stays, if it is more than a speck.
      const bool stands_out = nearest[i].distance > double{unlike_colours} * unlike_colours;
      if (stands_out && 4 * means[i].area >= least_area) continue;
      sets.join(static_cast<std::int32_t>(i), nearest[i].region);
      joined = true;
    }
    if (!joined) break;
    const int width = regions.of.width();
    regions = numbered(width, regions.of.height(), means.size(), [&](std::int32_t index) {
      const std::int32_t region = regions.of(index % width, index / width);
      return region < 0 ? -1 : sets.find(region);
    });
  }
  return regions;
}

}  // namespace wheatstone
