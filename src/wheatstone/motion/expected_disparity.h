#pragma once

#include "wheatstone/motion/flow.h"

namespace wheatstone {

/// A picture of the frame before, brought along the flow to this one. `to_before` leads from this frame's pixels to
/// that one's; both may be of other sizes than the result. `unknown` where the flow leads out of the picture or is
/// unknown.
template <class Pixel>
Image<Pixel> brought_along(const Image<Pixel>& before, const Flow& to_before, int width, int height, Pixel unknown);

/// The disparity of the frame before, brought along the flow to where it is expected now; NaN is unknown.
Image<float> expected_disparity(const Image<float>& before, const Flow& to_before, int width, int height);

/// 255 where nothing moves: where the flow is shorter than half a pixel of a frame of `frame_width` pixels.
Image<std::uint8_t> still_places(const Flow& to_before, int frame_width, int width, int height);

}  // namespace wheatstone
