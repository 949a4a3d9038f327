#pragma once

// Between StereoLayout and what containers and codecs say of it.

#include <optional>

extern "C" {
#include <libavutil/stereo3d.h>
}

#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {

/// The layout that stereo side data tells. Whether the eyes are squeezed it does not tell: they are where the pixels
/// are twice as wide (side by side) or high (one above the other) as they ought to be, or where a frame of 720 or more
/// rows is 16:9 without a word on its pixels, as broadcasters send them.
StereoLayout layout_of(const AVStereo3D& stereo, int width, int height, AVRational pixel_aspect);

/// The side data for a layout; nothing for mono.
std::optional<AVStereo3D> stereo_of(StereoLayout layout);

/// The shape of a pixel that says that the eyes are squeezed.
Rational pixel_aspect_of(StereoLayout layout);

/// The number in H.264's frame packing message; nothing where it has none. x264 always says that the left eye is first.
std::optional<int> frame_packing_of(StereoLayout layout);

}  // namespace wheatstone
