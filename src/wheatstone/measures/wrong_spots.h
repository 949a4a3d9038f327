#pragma once

#include <cstdint>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Places of a painting whose colour its photograph has nowhere near, as where paint of one surface lies on another.
struct WrongSpots {
  double spots_per_100000_px = 0;
  double share = 0;  ///< of the pixels, 0..1, that lie in a spot
};

/// 255 where every pixel of the photograph within 4 pixels (of a picture 640 wide, in proportion otherwise) has an RGB
/// distance of more than 60 (of 441) from the painting's. Throws Error{bad_input} where the sizes differ.
Image<std::uint8_t> wrong_pixels(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph);

/// A spot is a connected set, at sides or corners, of at least 4 wrong pixels. Throws as wrong_pixels.
WrongSpots measure_wrong_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph);

/// Of both eyes together.
WrongSpots measure_wrong_spots(const StereoPairView& painted, const StereoPairView& photographs);

}  // namespace wheatstone
