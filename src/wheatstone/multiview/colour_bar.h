#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/multiview/tone.h"

namespace wheatstone {

/// The colours of mass from the lower limit on the left to the upper one on the right, in even steps of brightness; of
/// the ramp, the hues from the cold one below to the hot one above. Both limits are known.
Image<Rgb8> colour_bar(const ToneSettings& settings, int width, int height);

/// The number that has a brightness, 0..1, between the limits, which are known.
float value_at(const ToneSettings& settings, float brightness);

/// The brightness, 0..1 where a number lies between the limits, which are known: the inverse of value_at.
float brightness_at(const ToneSettings& settings, float value);

}  // namespace wheatstone
