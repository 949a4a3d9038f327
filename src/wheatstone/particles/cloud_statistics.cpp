#include "wheatstone/particles/cloud_statistics.h"

#include <algorithm>
#include <bit>

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

void PositionSample::add(const Cloud& cloud) {
  constexpr std::size_t most = 1 << 17;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    // Multiples of the golden ratio spread evenly: a key's limit keeps a share of any stretch of the file.
    const auto key = static_cast<std::uint32_t>(seen_++ * 0x9E3779B97F4A7C15u >> 32);
    if (key > highest_key_) continue;
    kept_.push_back({key, {cloud.x[i], cloud.y[i], cloud.z[i]}});
    if (kept_.size() <= most) continue;
    highest_key_ /= 2;
    std::erase_if(kept_, [this](const Kept& kept) { return kept.key > highest_key_; });
  }
}

std::array<std::vector<float>, 3> PositionSample::axes() const {
  std::array<std::vector<float>, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Kept& kept : kept_) axes[axis].push_back(kept.at[axis]);
  return axes;
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
  positions.add(cloud);
  count += cloud.size();
  density.add(cloud.density);
  temperature.add(cloud.temperature);
  has_density = has_density || !cloud.density.empty();
  has_temperature = has_temperature || !cloud.temperature.empty();
  has_colour = has_colour || !cloud.colour.empty();
  has_smoothing_length = has_smoothing_length || !cloud.smoothing_length.empty();
}

std::array<float, 3> CloudStatistics::centre() const {
  return framed ? framed->centre() : FramedRegion{.lower = lower, .upper = upper}.centre();
}

float CloudStatistics::radius() const {
  return framed ? framed->radius() : FramedRegion{.lower = lower, .upper = upper}.radius();
}

}  // namespace wheatstone
