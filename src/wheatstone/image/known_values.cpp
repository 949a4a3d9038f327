#include "wheatstone/image/known_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {

bool is_known_anywhere(ImageView<const float> values) {
  for (int y = 0; y < values.height(); ++y)
    if (std::ranges::any_of(values.row(y), [](float value) { return std::isfinite(value); })) return true;
  return false;
}

RangeWithZero range_with_zero(ImageView<const float> values) {
  RangeWithZero range;
  for (int y = 0; y < values.height(); ++y) {
    for (const float value : values.row(y)) {
      if (!std::isfinite(value)) continue;
      range.least = std::min(range.least, value);
      range.largest = std::max(range.largest, value);
    }
  }
  return range;
}

void check_known_anywhere(ImageView<const float> values, std::string_view name) {
  if (!is_known_anywhere(values))
    throw Error(ErrorKind::bad_input,
                fmt::format("{} is unknown everywhere, expected at least one finite value", name));
}

}  // namespace wheatstone
