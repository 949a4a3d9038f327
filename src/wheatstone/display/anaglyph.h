#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// One picture for red–cyan glasses, by Dubois' least-squares matrices (ICASSP 2001; his values for sRGB displays):
/// applied in linear light, each eye's part clipped before they are added. The pair's size.
Image<Rgb8> anaglyph(const StereoPair& pair);

}  // namespace wheatstone
