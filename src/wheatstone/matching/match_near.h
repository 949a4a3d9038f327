#pragma once

#include <optional>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// Finds the disparity of every pixel of a rectified pair of which it is roughly known already, as in a film: near what
/// is expected, or near what a coarse copy of the pair shows over the whole range where that fits the pictures better.
/// `expected` is of the left picture, of any size, in pixels of the pair; NaN where nothing is expected. Of the
/// options, `range` must be given; `size`, the check's tolerance and the least surface count. Semi-global matching with
/// a band of its own for every pixel, as in Rothermel et al. 2012 (SURE). The same result on any number of threads.
/// Where `still`, of the size that is matched, is not 0, nothing has moved since `expected` was found: what is expected
/// stays there unless another disparity fits better, so that depth does not flicker. None where no pixel matches, and
/// where pictures are smaller than 32 pixels.
std::optional<MatchedPair> match_near(const StereoPair& pair, const Image<float>& expected, const MatchOptions& options,
                                      ImageView<const std::uint8_t> still = {});

}  // namespace wheatstone
