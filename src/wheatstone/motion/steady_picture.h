#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/motion/flow.h"

namespace wheatstone {

/// A film's picture with its flicker taken out: each pixel the mean of what its point looked like in the last frames.
struct SteadyPicture {
  Image<SampledColour> colours;
  Image<std::uint8_t> frames;  ///< that each pixel's mean is of, from 1, up to a few
};

/// A scene's first frame, alone.
SteadyPicture begin_steady(ImageView<const Rgb8> frame);

/// The next frame joins the mean: what was is carried along the backward flow where that is `known`, 255, and forgotten
/// where the frame looks unlike it. All are of one size.
void steady(ImageView<const Rgb8> frame, const Flow& backward, ImageView<const std::uint8_t> known,
            SteadyPicture& picture);

Rgb8 rounded(const SampledColour& colour);

/// Its colours, rounded.
Image<Rgb8> rounded(const Image<SampledColour>& colours);

}  // namespace wheatstone
