#pragma once

#include "wheatstone/motion/flow.h"

namespace wheatstone {

/// A film's picture with its noise averaged over time: mixed with the steady picture before, carried along the backward
/// flow, where `kept` (255) says that the flow is confirmed and the two agree in colour; the picture itself elsewhere.
/// All images are of one size.
Image<Rgb8> steady_picture(ImageView<const Rgb8> picture, ImageView<const Rgb8> steady_before, const Flow& backward,
                           ImageView<const std::uint8_t> kept);

}  // namespace wheatstone
