#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// The right picture that belongs to a depth that a hand has changed from `found` to `retouched`. A hand that corrects
/// a wrong depth makes it what both pictures show. One that gives a thing another depth wants it elsewhere in the right
/// picture, which shows it where it was: the thing moves there, and what it leaves is continued from the farther
/// surface beside it. Pixels that fit the new depth stay. Empty where all do. Geometries have the pictures' size.
Image<Rgb8> retouched_right(const StereoPairView& pictures, const StereoGeometryView& found,
                            const StereoGeometryView& retouched);

}  // namespace wheatstone
