#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace wheatstone {

inline constexpr std::array<std::string_view, 6> built_in_brush_names{"round", "flat",  "filbert",
                                                                      "fan",   "knife", "charcoal"};

/// The pictures of the folder brushes/, row by row, in the order of their names. Written by the build.
extern const std::array<const std::uint8_t*, built_in_brush_names.size()> built_in_brushes;

}  // namespace wheatstone
