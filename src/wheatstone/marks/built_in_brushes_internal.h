#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace wheatstone {

struct BuiltInBrush {
  std::string_view name;
  const std::uint8_t* cover;  ///< of BrushPicture::length × width pixels, row by row
};

/// The pictures of the folder brushes/. Written by the build.
std::span<const BuiltInBrush> built_in_brushes();

}  // namespace wheatstone
