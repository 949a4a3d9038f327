#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace wheatstone::bench {

/// The median time of one call in seconds, over some calls after one that is not counted.
template <class Call>
double median_seconds(Call call, int calls = 5) {
  call();
  std::vector<double> times;
  for (int i = 0; i < calls; ++i) {
    const auto start = std::chrono::steady_clock::now();
    call();
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::nth_element(times, times.begin() + calls / 2);
  return times[static_cast<std::size_t>(calls / 2)];
}

}  // namespace wheatstone::bench
