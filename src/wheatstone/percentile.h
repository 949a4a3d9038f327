#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wheatstone {

/// The value below which the given share, 0..1, of the values lies; 0.5 is the median. A value that is there, never one
/// between two. `values` must not be empty, nor hold NaN.
template <class Number>
Number percentile(std::vector<Number> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace wheatstone
