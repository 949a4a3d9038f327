#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

namespace wheatstone::bench {

template <class Call>
double seconds_of(Call call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> times) {
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::ranges::nth_element(times, middle);
  return *middle;
}

/// The median time of one call in seconds, over some calls after one that is not counted.
template <class Call>
double median_seconds(Call call, int calls = 5) {
  call();
  std::vector<double> times;
  for (int i = 0; i < calls; ++i) times.push_back(seconds_of(call));
  return median(times);
}

/// Two median times and the first as a multiple of the second.
struct Compared {
  double first_s, second_s, ratio;
};

/// Times two calls in rounds, one after the other: a machine is faster at one time than at another, and both of a round
/// meet the same. The medians of all rounds, and of the rounds' ratios.
template <class First, class Second>
Compared compare_times(First first, Second second, int rounds = 5, int calls = 3) {
  std::vector<double> of_first, of_second, ratios;
  for (int i = 0; i < rounds; ++i) {
    of_first.push_back(median_seconds(first, calls));
    of_second.push_back(median_seconds(second, calls));
    ratios.push_back(of_first.back() / of_second.back());
  }
  return {median(of_first), median(of_second), median(ratios)};
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

/// Seconds in which one thread copies so many bytes of memory, the median of some: what it takes to read and write them
/// once, whatever is done with them.
inline double copy_seconds(std::size_t bytes) {
  std::vector<char> from(bytes, 1), to(bytes);
  return median_seconds([&] { std::memcpy(to.data(), from.data(), bytes); });
}

}  // namespace wheatstone::bench
