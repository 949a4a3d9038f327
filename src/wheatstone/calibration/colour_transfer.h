#pragma once

#include <array>
#include <optional>
#include <span>

#include "wheatstone/image/image.h"
#include "wheatstone/matching/match_features.h"

namespace wheatstone {

/// What makes one eye's exposure and colour the other's: sRGB code / 255 becomes gain · (code / 255)^gamma, a channel
/// each (red, green, blue).
struct ColourTransfer {
  std::array<double, 3> gain{1, 1, 1};
  std::array<double, 3> gamma{1, 1, 1};
};

/// The transfer from the right picture to the left one, from the small surroundings of matched places; what differs
/// otherwise (reflections, wrong matches) is outvoted. None where fewer than 24 matches can be compared.
std::optional<ColourTransfer> find_colour_transfer(ImageView<const Rgb8> left, ImageView<const Rgb8> right,
                                                   std::span<const FeatureMatch> matches);

void apply_colour_transfer(const ColourTransfer& transfer, ImageView<Rgb8> picture);

}  // namespace wheatstone
