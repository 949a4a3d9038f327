#pragma once

#include <sys/resource.h>

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

/// Seconds that all threads of this process have computed.
inline double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The processor time of one call in seconds: the least of some.
template <class Call>
double least_processor_seconds(Call call, int calls = 3) {
  double least = 0;
  for (int i = 0; i < calls; ++i) {
    const double before = processor_seconds();
    call();
    const double taken = processor_seconds() - before;
    if (i == 0 || taken < least) least = taken;
  }
  return least;
}

}  // namespace wheatstone::bench
