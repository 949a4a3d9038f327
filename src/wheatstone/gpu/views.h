#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// As many views as one run of a program makes: their positions are part of its work.
constexpr int most_gpu_views = 64;  // and most_views of views.glsl

/// Eye separations to the right of the central view, for a program's work.
inline std::array<float, most_gpu_views> gpu_views(std::span<const ViewPosition> views) {
  std::array<float, most_gpu_views> distances{};
  for (std::size_t v = 0; v < views.size(); ++v) distances[v] = views[v] - central_view;
  return distances;
}

/// A pixel as programs read and write it.
constexpr std::uint32_t packed(Rgb8 colour) {
  return colour.r | static_cast<std::uint32_t>(colour.g) << 8 | static_cast<std::uint32_t>(colour.b) << 16;
}

/// Copies the pixels of one view, row by row, as programs write them: red in the lowest byte, then green and blue.
inline void unpack(std::span<const std::uint32_t> pixels, ImageView<Rgb8> picture) {
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const std::uint32_t colour = pixels[static_cast<std::size_t>(y) * picture.width() + x];
      picture.row(y)[x] = {static_cast<std::uint8_t>(colour), static_cast<std::uint8_t>(colour >> 8),
                           static_cast<std::uint8_t>(colour >> 16)};
    }
}

}  // namespace wheatstone
