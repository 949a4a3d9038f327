#pragma once

#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Whether a map of disparity or depth has a finite value anywhere.
bool is_known_anywhere(ImageView<const float> values);

/// The least and the largest of a map's finite values, and of 0.
struct RangeWithZero {
  float least = 0, largest = 0;
};
RangeWithZero range_with_zero(ImageView<const float> values);

/// Throws Error{bad_input}, "NAME is unknown everywhere, expected at least one finite value", where it has none.
void check_known_anywhere(ImageView<const float> values, std::string_view name);

}  // namespace wheatstone
