#pragma once

#include <cstdint>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Places of a painting whose colour its photograph has nowhere near, as where paint of one surface lies on another.
struct WrongSpots {
  double spots_per_100000_px = 0;
  double share = 0;  ///< of the pixels, 0..1, that lie in a spot
};

/// By what two colours are told apart: a distance in RGB, 0..441, of more than 60, which is also the residual of the
/// planners (marks/residual.h); or one in OKLab of more than 0.11, which no planner knows. On the way to OKLab, 1 % of
/// white is added to both, as what a display reflects (IEC 61966-2-1): without it, black would differ from everything.
enum class ColourDistance { rgb, oklab };

/// 255 where all colours of the photograph within 4 pixels (of a picture 640 wide, in proportion otherwise) differ from
/// the painting's. Throws Error{bad_input} where the sizes differ.
Image<std::uint8_t> wrong_pixels(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph,
                                 ColourDistance distance = ColourDistance::rgb);

/// A spot is a connected set, at sides or corners, of at least 4 wrong pixels. Throws as wrong_pixels.
WrongSpots measure_wrong_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph,
                               ColourDistance distance = ColourDistance::rgb);

/// Of both eyes together.
WrongSpots measure_wrong_spots(const StereoPairView& painted, const StereoPairView& photographs,
                               ColourDistance distance = ColourDistance::rgb);

}  // namespace wheatstone
