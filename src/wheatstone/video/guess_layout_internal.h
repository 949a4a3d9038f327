#pragma once

#include <span>
#include <string>

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

/// A layout and, in a few words for the user, how it is known.
struct GuessedLayout {
  StereoLayout layout = StereoLayout::mono;
  std::string how;
};

/// Tells from a few frames of one film whether they hold two eyes: the halves of a packed frame show the same, shifted
/// a little sideways; the halves of a plain frame do not. Compares the details (zero-mean, blurred to about 160
/// columns) of the left and right halves and of the upper and lower halves, each under the best sideways shift up to 8
/// % of the width, and takes what correlates above 0.55 on average. Halves whose proportions no camera gives (upright
/// side by side, wider than 2.4 : 1 one above the other) are taken for squeezed. Which half is the left eye's cannot be
/// seen: the left or upper one is assumed, and said. Fooled by a plain film of a repeating pattern.
GuessedLayout guess_layout(std::span<const Image<Rgb8>> frames);

}  // namespace wheatstone
