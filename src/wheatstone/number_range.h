#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "wheatstone/error.h"

namespace wheatstone {

/// What a number may be, both ends included.
struct NumberRange {
  double least;
  double most;
  /// False for NaN.
  constexpr bool has(double value) const { return value >= least && value <= most; }
};

/// What has no better bound: far beyond anything sensible, and yet safe to calculate with in single precision.
inline constexpr double no_bound = 1e30;

/// As few digits as tell it: "1000000", "0.01", "1e+30", "nan".
inline std::string number_text(double value) {
  std::array<char, 32> digits{};
  const bool is_whole = std::abs(value) < 1e15 && value == std::floor(value);
  const auto end = is_whole ? std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<long long>(value))
                            : std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end.ptr};
}

/// " from 0 to 100", " of at least 0", or nothing.
inline std::string words_of(NumberRange range) {
  if (range.least <= -no_bound && range.most >= no_bound) return {};
  if (range.most >= no_bound) return " of at least " + number_text(range.least);
  return " from " + number_text(range.least) + " to " + number_text(range.most);
}

/// Throws Error{wrong_usage} that names the number, "span: is nan, expected a number from 0 to 100", where it is not in
/// its range.
template <class Number>
void check_number(std::string_view name, Number value, NumberRange range) {
  if (range.has(static_cast<double>(value))) return;
  // The shortest digits of single precision are not those of double precision.
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  throw Error(ErrorKind::wrong_usage, std::string(name) + ": is " + std::string(digits.data(), end.ptr) +
                                          ", expected a number" + words_of(range));
}

}  // namespace wheatstone
