#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// How much of its paint a brush leaves from place to place: a picture that is stretched over each stroke, with the
/// stroke's length along x, and from its left to its right along y. 255 covers, 0 leaves the ground bare.
struct BrushPicture {
  static constexpr int length = 256, width = 64;

  /// The picture and its reductions, each half as large as the one before: a thin stroke shows no single bristle.
  struct Level {
    int columns, rows;
    std::size_t first;  ///< byte of `levels`
  };
  static constexpr std::array<Level, 5> sizes{
      {{256, 64, 0}, {128, 32, 16384}, {64, 16, 20480}, {32, 8, 21504}, {16, 4, 21760}}};
  static constexpr std::size_t all_bytes = 21824 + 4;  ///< behind the last pixel, four bytes may be loaded, too

  std::string name;                  ///< of a built-in brush, or of its file
  std::vector<std::uint8_t> levels;  ///< all_bytes, row by row; empty: the brush leaves paint everywhere

  bool empty() const { return levels.empty(); }
  /// The picture alone: length × width.
  std::span<const std::uint8_t> cover() const { return std::span(levels).first(empty() ? 0 : length * width); }
  friend bool operator==(const BrushPicture&, const BrushPicture&) = default;
};

/// The level whose rows are about as many as the pixels across a stroke.
int brush_level(float radius_px);

/// From length × width values.
BrushPicture brush_picture(std::string name, std::span<const std::uint8_t> cover);

/// The names of the built-in brushes.
std::span<const std::string_view> brush_names();

/// A built-in brush by its name; empty where there is none such.
BrushPicture built_in_brush(std::string_view name);

}  // namespace wheatstone
