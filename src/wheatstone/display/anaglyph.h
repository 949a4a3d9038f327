#pragma once

#include <span>
#include <string_view>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A way to put two views into one picture for coloured glasses.
struct AnaglyphKind {
  std::string_view name;    ///< "red-cyan", "half-colour" …
  std::string_view ffmpeg;  ///< what its stereo3d filter calls it; empty where it has no such mode
  std::string_view glasses;
  bool linear_light;  ///< Dubois' own way; ffmpeg's and the older kinds mix encoded values
};

/// All that have a name: Dubois' least squares for three kinds of glasses, in linear light (red-cyan, green-magenta,
/// amber-blue) and as ffmpeg applies them to encoded values; true, grey, colour, half-colour and optimised.
std::span<const AnaglyphKind> anaglyph_kinds();

/// One picture for glasses of that kind, the pair's size. Dubois' matrices (ICASSP 2001; his values for sRGB displays)
/// are applied in linear light, each eye's part clipped before they are added. Kinds that ffmpeg has are equal to its
/// filter's within rounding.
Image<Rgb8> anaglyph(const StereoPairView& pair, const AnaglyphKind& kind);

/// For red-cyan glasses.
Image<Rgb8> anaglyph(const StereoPairView& pair);

}  // namespace wheatstone
