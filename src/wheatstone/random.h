#pragma once

#include <cstdint>
#include <initializer_list>

namespace wheatstone {

/// A hash of a few numbers: the only source of randomness, so that the same input and seed give the same bytes on any
/// number of threads. The mixing is SplitMix64's.
constexpr std::uint64_t hash_keys(std::initializer_list<std::uint64_t> keys) {
  std::uint64_t state = 0x9E3779B97F4A7C15ull;
  for (const std::uint64_t key : keys) {
    state += key + 0x9E3779B97F4A7C15ull;
    state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9ull;
    state = (state ^ (state >> 27)) * 0x94D049BB133111EBull;
    state ^= state >> 31;
  }
  return state;
}

/// Uniform in [0, 1) from a hash.
constexpr float unit_float(std::uint64_t hashed) { return static_cast<float>(hashed >> 40) * 0x1p-24f; }

}  // namespace wheatstone
