#pragma once

#include <cstdint>
#include <span>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// 255 where the colours of two rows are unlike (wrong_spots.h), 0 elsewhere.
void mark_unlike_colours(std::span<const Rgb8> a, std::span<const Rgb8> b, std::span<std::uint8_t> marks);

}  // namespace wheatstone
