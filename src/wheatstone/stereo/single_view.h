#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A pair whose right picture no camera took.
struct MadePair {
  StereoPair pictures;
  StereoGeometry geometry;  ///< no unknowns
};

/// Makes a pair of one picture and its disparity: the picture is the left eye's, and the right eye's is the same,
/// carried along its disparity. Uncovered parts belong to the farther surface beside them: they take its disparity, and
/// its texture, mirrored at the edge. Pixels next to the edge, where the camera mixed the colours of two surfaces, are
/// left out. Unknown disparities (NaN) are filled as by `geometry_from_left`. Throws Error{bad_input} where sizes
/// differ or no disparity is known.
MadePair make_pair_from_single_view(Image<Rgb8> picture, Image<float> disparity);

}  // namespace wheatstone
