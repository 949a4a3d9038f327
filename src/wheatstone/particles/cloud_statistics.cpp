#include "wheatstone/particles/cloud_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

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

void LogHistogram::add(const LogHistogram& other) {
  for (std::size_t step = 0; step < counts_.size(); ++step) counts_[step] += other.counts_[step];
  total_ += other.total_;
}

namespace {

/// Multiples of the golden ratio spread evenly: a key's limit keeps a share of any stretch of the file.
std::uint32_t key_of(std::uint64_t number) { return static_cast<std::uint32_t>(number * 0x9E3779B97F4A7C15u >> 32); }

constexpr std::size_t most_kept = 1 << 17;

template <class Column>
void put_bytes(const Column& column, Ranks::Bytes& to) {
  const std::uint64_t size = column.size();
  const auto put = [&](std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); };
  put(std::as_bytes(std::span(&size, 1)));
  put(std::as_bytes(std::span(column)));
}

template <class Value>
void take_bytes(std::span<const std::byte>& from, std::vector<Value>& column) {
  std::uint64_t size = 0;
  std::memcpy(&size, from.data(), sizeof(size));
  from = from.subspan(sizeof(size));
  const std::size_t before = column.size();
  column.resize(before + size);
  if (size > 0) std::memcpy(column.data() + before, from.data(), size * sizeof(Value));
  from = from.subspan(size * sizeof(Value));
}

}  // namespace

void ParticleSample::add(const Cloud& cloud, std::uint64_t before) {
  if (cloud.size() == 0) return;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (key_of(before + i) > highest_key_) continue;
    numbers_.push_back(before + i);
    for_each_column(kept_, cloud, [i](auto& to, const auto& from) {
      if (!from.empty()) to.push_back(from[i]);
    });
    if (numbers_.size() <= most_kept) continue;
    highest_key_ /= 2;
    thin_out();
  }
  kept_.origin = cloud.origin;
  kept_.box_size = cloud.box_size;
}

/// Removes those whose keys are too high.
void ParticleSample::thin_out() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    if (key_of(numbers_[k]) > highest_key_) continue;
    for_each_column(kept_, kept_, [&](auto& to, const auto& /*same*/) {
      if (!to.empty()) to[kept] = to[k];
    });
    numbers_[kept++] = numbers_[k];
  }
  numbers_.resize(kept);
  for_each_column(kept_, kept_, [&](auto& to, const auto& /*same*/) {
    if (!to.empty()) to.resize(kept);
  });
}

void ParticleSample::share(const Ranks& ranks) {
  if (ranks.alone()) return;
  // The limit that one rank would have come to: the highest that leaves few enough of all.
  struct Kept {
    std::uint32_t highest_key;
    std::array<std::uint64_t, 33> below;  ///< keys up to the highest there is, halved so often
  };
  Kept mine{.highest_key = highest_key_, .below = {}};
  for (const std::uint64_t number : numbers_)
    for (std::size_t halvings = 0; halvings < mine.below.size(); ++halvings)
      mine.below[halvings] += key_of(number) <= (std::uint64_t{0xFFFFFFFF} >> halvings);
  Kept all{.highest_key = 0xFFFFFFFF, .below = {}};
  for (const Kept& of_rank : ranks.from_all(mine)) {
    all.highest_key = std::min(all.highest_key, of_rank.highest_key);
    for (std::size_t halvings = 0; halvings < all.below.size(); ++halvings)
      all.below[halvings] += of_rank.below[halvings];
  }
  highest_key_ = all.highest_key;
  while (all.below[static_cast<std::size_t>(std::countl_zero(highest_key_))] > most_kept) highest_key_ /= 2;
  thin_out();

  Ranks::Bytes bytes;
  put_bytes(numbers_, bytes);
  std::apply([&](const auto&... column) { (put_bytes(column, bytes), ...); }, columns_of(std::as_const(kept_)));
  for (const double number : {kept_.origin[0], kept_.origin[1], kept_.origin[2], kept_.box_size})
    put_bytes(std::array{number}, bytes);
  std::vector<std::uint64_t> numbers;
  Cloud together;
  for (const Ranks::Bytes& of_rank : ranks.from_all(bytes)) {
    std::span<const std::byte> rest = of_rank;
    const std::size_t before = numbers.size();
    take_bytes(rest, numbers);
    std::apply([&](auto&... column) { (take_bytes(rest, column), ...); }, columns_of(together));
    std::vector<double> place;
    for (int i = 0; i < 4; ++i) take_bytes(rest, place);
    if (numbers.size() == before) continue;
    together.origin = {place[0], place[1], place[2]};
    together.box_size = place[3];
  }

  // In the order of the file.
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  kept_ = {};
  kept_.origin = together.origin;
  kept_.box_size = together.box_size;
  for_each_column(kept_, together, [&](auto& to, const auto& from) {
    if (from.empty()) return;
    for (const std::size_t i : order) to.push_back(from[i]);
  });
  std::ranges::sort(numbers);
  numbers_ = std::move(numbers);
}

void CloudStatistics::add(const Cloud& cloud, std::uint64_t before) {
  const std::array<const std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cloud.size() == 0) continue;
    const auto [least, most] = std::ranges::minmax(*axes[axis]);
    lower[axis] = count == 0 ? least : std::min(lower[axis], least);
    upper[axis] = count == 0 ? most : std::max(upper[axis], most);
  }
  if (cloud.size() > 0) origin = cloud.origin;
  sample.add(cloud, before);
  if (grid) grid->add(cloud);
  count += cloud.size();
  density.add(cloud.density);
  temperature.add(cloud.temperature);
  for (const float one : cloud.quantity) largest_quantity = std::max(largest_quantity, std::abs(one));
  // Chunk by chunk, so that ranks that read every other chunk come to the same sum.
  mass += cloud.mass.empty() ? static_cast<double>(cloud.size())
                             : std::accumulate(cloud.mass.begin(), cloud.mass.end(), 0.);
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

void CloudStatistics::share(const Ranks& ranks) {
  if (ranks.alone()) return;
  sample.share(ranks);
  struct Plain {
    std::uint64_t count;
    std::array<double, 3> origin;
    std::array<float, 3> lower, upper;
    LogHistogram density, temperature;
    float largest_quantity;
    bool has_density, has_temperature, has_colour, has_smoothing_length, has_mass;
  };
  const Plain mine{count,
                   origin,
                   lower,
                   upper,
                   density,
                   temperature,
                   largest_quantity,
                   has_density,
                   has_temperature,
                   has_colour,
                   has_smoothing_length,
                   has_mass};
  count = 0;
  density = temperature = {};
  for (const Plain& of_rank : ranks.from_all(mine)) {
    if (of_rank.count == 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = count == 0 ? of_rank.lower[axis] : std::min(lower[axis], of_rank.lower[axis]);
      upper[axis] = count == 0 ? of_rank.upper[axis] : std::max(upper[axis], of_rank.upper[axis]);
    }
    count += of_rank.count;
    origin = of_rank.origin;
    density.add(of_rank.density);
    temperature.add(of_rank.temperature);
    largest_quantity = std::max(largest_quantity, of_rank.largest_quantity);
    has_density |= of_rank.has_density;
    has_temperature |= of_rank.has_temperature;
    has_colour |= of_rank.has_colour;
    has_smoothing_length |= of_rank.has_smoothing_length;
    has_mass |= of_rank.has_mass;
  }
}

std::array<float, 3> CloudStatistics::centre() const {
  return framed ? framed->centre() : FramedRegion{.lower = lower, .upper = upper}.centre();
}

float CloudStatistics::radius() const {
  return framed ? framed->radius() : FramedRegion{.lower = lower, .upper = upper}.radius();
}

}  // namespace wheatstone
