#include "wheatstone/image/known_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheatstone {
namespace {

/// The number of unknown pixels at the beginning of a row, in whole chunks.
std::size_t unknown_chunks(std::span<const float> row) {
  constexpr std::size_t chunk = 16;
  std::size_t pixels = 0;
  for (; pixels + chunk <= row.size(); pixels += chunk) {
    int known = 0;
    for (std::size_t i = 0; i < chunk; ++i) known |= row[pixels + i] == row[pixels + i] ? 1 : 0;
    if (known != 0) break;
  }
  return pixels;
}

bool is_unknown(float value) { return std::isnan(value); }

}  // namespace

KnownRuns::KnownRuns(int width, int height) : width_(width), first_runs_{0} {
  first_runs_.reserve(static_cast<std::size_t>(height) + 1);
  values_.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));  // unused, it costs nothing
}

KnownRuns::KnownRuns(ImageView<const float> map) : KnownRuns(map.width(), map.height()) {
  for (int y = 0; y < map.height(); ++y) add_row(map.row(y));
}

void KnownRuns::add_row(std::span<const float> row) {
  for (auto end = row.begin();;) {
    end += static_cast<std::ptrdiff_t>(unknown_chunks({end, row.end()}));
    const auto begin = std::find_if_not(end, row.end(), is_unknown);
    if (begin == row.end()) break;
    end = std::find_if(begin, row.end(), is_unknown);
    runs_.push_back({static_cast<int>(begin - row.begin()), static_cast<int>(end - row.begin()), values_.size()});
    values_.insert(values_.end(), begin, end);
  }
  first_runs_.push_back(runs_.size());
}

float KnownRuns::operator()(int x, int y) const {
  const std::span<const Run> row = runs_of(y);
  const auto run = std::ranges::upper_bound(row, x, {}, &Run::end);
  return run == row.end() || run->begin > x ? std::numeric_limits<float>::quiet_NaN()
                                            : values_of(*run)[static_cast<std::size_t>(x - run->begin)];
}

void KnownRuns::copy_row(int y, std::span<float> to) const {
  std::ranges::fill(to, std::numeric_limits<float>::quiet_NaN());
  for (const Run& run : runs_of(y)) std::ranges::copy(values_of(run), to.begin() + run.begin);
}

}  // namespace wheatstone
