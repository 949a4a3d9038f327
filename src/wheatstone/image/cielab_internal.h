#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// CIE L*a*b* for the white of sRGB, D65: lightness 0..100, and green to red and blue to yellow, about -110..110.
struct Cielab {
  float lightness = 0, a = 0, b = 0;
};

/// Of an sRGB colour (CIE 15; IEC 61966-2-1).
Cielab cielab_of(Rgb8 colour);

}  // namespace wheatstone
