#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <span>
#include <utility>

#include "wheatstone/random.h"

namespace wheatstone {

/// Random numbers one after the other, each a hash of the keys and its place in the row.
class Lots {
 public:
  explicit Lots(std::initializer_list<std::uint64_t> keys) : key_(hash_keys(keys)) {}

  std::uint64_t next() { return hash_keys({key_, count_++}); }
  /// Uniform in [0, 1).
  float unit() { return unit_float(next()); }
  /// Uniform in [0, 1), in double precision.
  double fine_unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Uniform in 0 … count − 1.
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  /// Normally distributed (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - fine_unit()));
    return radius * std::cos(2 * std::numbers::pi * fine_unit());
  }
  /// Puts values into a random order (Fisher and Yates).
  template <class Value>
  void shuffle(std::span<Value> values) {
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[static_cast<std::size_t>(below(static_cast<int>(i)))]);
  }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace wheatstone
