#include "wheatstone/particles/cloud_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace wheatstone {

void LogHistogram::add(const std::vector<float>& values) {
  // Several tables in turn: neighbours often fall in one step, and a sum would wait for the one before.
  constexpr std::size_t tables = 4;
  std::array<std::array<std::uint32_t, steps>, tables> counts;
  constexpr std::size_t most_at_once = std::size_t{1} << 30;  // as many as a table can count
  for (std::size_t first = 0; first < values.size(); first += most_at_once) {
    const std::size_t end = std::min(first + most_at_once, values.size());
    for (auto& table : counts) table.fill(0);
    for (std::size_t i = first; i < end; ++i) {
      // The exponent and the first four bits of the mantissa number the step; zero, negative, infinite and NaN have
      // none.
      const auto bits = std::bit_cast<std::uint32_t>(values[i]);
      if (bits - 1 >= 0x7F800000u - 1) continue;
      ++counts[i % tables][bits >> 19];
    }
    for (const auto& table : counts)
      for (std::size_t step = 0; step < steps; ++step) {
        counts_[step] += table[step];
        total_ += table[step];
      }
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
constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;
constexpr std::uint32_t key_of_multiple(std::uint64_t multiple) { return static_cast<std::uint32_t>(multiple >> 32); }
constexpr std::uint32_t key_of(std::uint64_t number) { return key_of_multiple(number * golden); }

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
  std::uint64_t multiple = before * golden;
  for (std::size_t i = 0; i < cloud.size(); ++i, multiple += golden) {
    if (key_of_multiple(multiple) > highest_key_) continue;
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

namespace {

// Sums and extremes of so many numbers in turn do not wait for each other, whatever the processor's vectors are.
constexpr std::size_t strands = 16;

struct Extremes {
  float least, most;
};

Extremes extremes_of(const std::vector<float>& values) {
  std::array<float, strands> least, most;
  least.fill(values.front());
  most.fill(values.front());
  const std::size_t whole = values.size() / strands * strands;
  for (std::size_t i = 0; i < whole; i += strands)
    for (std::size_t k = 0; k < strands; ++k) {
      const float value = values[i + k];
      least[k] = value < least[k] ? value : least[k];
      most[k] = value > most[k] ? value : most[k];
    }
  Extremes extremes{std::ranges::min(least), std::ranges::max(most)};
  for (std::size_t i = whole; i < values.size(); ++i)
    extremes = {std::min(extremes.least, values[i]), std::max(extremes.most, values[i])};
  return extremes;
}

double sum_of(const std::vector<float>& values) {
  std::array<double, strands> sums{};
  const std::size_t whole = values.size() / strands * strands;
  for (std::size_t i = 0; i < whole; i += strands)
    for (std::size_t k = 0; k < strands; ++k) sums[k] += static_cast<double>(values[i + k]);
  for (std::size_t i = whole; i < values.size(); ++i) sums[i - whole] += static_cast<double>(values[i]);
  return std::accumulate(sums.begin(), sums.end(), 0.);
}

}  // namespace

void CloudStatistics::add(const Cloud& cloud, std::uint64_t before) {
  const std::array<const std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cloud.size() == 0) continue;
    const auto [least, most] = extremes_of(*axes[axis]);
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
  mass += cloud.mass.empty() ? static_cast<double>(cloud.size()) : sum_of(cloud.mass);
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
