#include "wheatstone/particles/cloud_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace wheatstone {

void LogHistogram::add(const std::vector<float>& values) {
  for (const float value : values) {
    // The exponent and the first four bits of the mantissa number the step; zero, negative, infinite and NaN have none.
    const auto bits = std::bit_cast<std::uint32_t>(value);
    if (bits == 0 || bits >= 0x7F800000u) continue;
    ++counts_[bits >> 19];
    ++total_;
  }
}

float LogHistogram::percentile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(total_));
  std::uint64_t below = 0;
  for (std::size_t step = 0; step < counts_.size(); ++step) {
    below += counts_[step];
    if (below > wanted || (below == total_ && below > 0))
      return std::bit_cast<float>(static_cast<std::uint32_t>(step) << 19 | 1u << 18);
  }
  return 0;
}

double LogHistogram::sum_of_inverses() const {
  double sum = 0;
  for (std::size_t step = 0; step < counts_.size(); ++step)
    if (counts_[step] > 0)
      sum +=
          static_cast<double>(counts_[step]) / std::bit_cast<float>(static_cast<std::uint32_t>(step) << 19 | 1u << 18);
  return sum;
}

void ParticleSample::add(const Cloud& cloud) {
  constexpr std::size_t most = 1 << 17;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    // Multiples of the golden ratio spread evenly: a key's limit keeps a share of any stretch of the file.
    const auto key = static_cast<std::uint32_t>(seen_++ * 0x9E3779B97F4A7C15u >> 32);
    if (key > highest_key_) continue;
    keys_.push_back(key);
    for_each_column(kept_, cloud, [i](auto& to, const auto& from) {
      if (!from.empty()) to.push_back(from[i]);
    });
    if (keys_.size() <= most) continue;
    highest_key_ /= 2;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      if (keys_[k] > highest_key_) continue;
      for_each_column(kept_, kept_, [&](auto& to, const auto& /*same*/) {
        if (!to.empty()) to[kept] = to[k];
      });
      keys_[kept++] = keys_[k];
    }
    keys_.resize(kept);
    for_each_column(kept_, kept_, [&](auto& to, const auto& /*same*/) {
      if (!to.empty()) to.resize(kept);
    });
  }
  kept_.origin = cloud.origin;
  kept_.box_size = cloud.box_size;
}

void CloudStatistics::add(const Cloud& cloud) {
  const std::array<const std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cloud.size() == 0) continue;
    const auto [least, most] = std::ranges::minmax(*axes[axis]);
    lower[axis] = count == 0 ? least : std::min(lower[axis], least);
    upper[axis] = count == 0 ? most : std::max(upper[axis], most);
  }
  if (cloud.size() > 0) origin = cloud.origin;
  sample.add(cloud);
  if (grid) grid->add(cloud);
  count += cloud.size();
  density.add(cloud.density);
  temperature.add(cloud.temperature);
  for (const float one : cloud.quantity) largest_quantity = std::max(largest_quantity, std::abs(one));
  for (const float one : cloud.mass) mass += one;
  if (cloud.mass.empty()) mass += static_cast<double>(cloud.size());
  has_density = has_density || !cloud.density.empty();
  has_temperature = has_temperature || !cloud.temperature.empty();
  has_mass = has_mass || !cloud.mass.empty();
  has_colour = has_colour || !cloud.colour.empty();
  has_smoothing_length = has_smoothing_length || !cloud.smoothing_length.empty();
}

void CloudStatistics::take_densities_of_grid() {
  grid->put_densities(sample.cloud());
  density.add(sample.cloud().density);
  has_density = has_smoothing_length = true;
}

std::array<float, 3> CloudStatistics::centre() const {
  return framed ? framed->centre() : FramedRegion{.lower = lower, .upper = upper}.centre();
}

float CloudStatistics::radius() const {
  return framed ? framed->radius() : FramedRegion{.lower = lower, .upper = upper}.radius();
}

}  // namespace wheatstone
