#pragma once

#include <cstdint>
#include <span>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// A row that is carried into another view: its colours, and where they land; a disparity of −∞ where none does.
struct LandedRow {
  std::span<const Rgb8> colours;
  std::span<const float> nearest;
  LandedFrom from;
};

/// The colour from one pixel to the next, at the fraction t.
inline Rgb8 blend(Rgb8 a, Rgb8 b, float t) {
  const int share = static_cast<int>(256 * t + 0.5f);
  const auto mix = [share](int from, int to) {
    return static_cast<std::uint8_t>((256 * from + share * (to - from) + 128) >> 8);
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// Writes it into a picture's row where that is empty, or farther by more than `tolerance_px`.
void compose_row(const LandedRow& landed, float tolerance_px, std::span<Rgb8> picture, std::span<float> disparity);

}  // namespace wheatstone
