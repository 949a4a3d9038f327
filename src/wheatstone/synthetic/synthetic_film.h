#pragma once

#include <optional>

#include "wheatstone/motion/flow.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {

enum class FilmMotion {
  walk,  ///< the camera moves about and turns, and the fruit beside the bowl hops, slides and turns
  pan    ///< the camera only turns, slowly; nothing else moves
};

struct SyntheticFilmOptions {
  /// The scene, the size of the views and their disparities; fine texture flickers where samples are few.
  SyntheticStillOptions still{.width = 960, .height = 540, .samples_a_side = 4};
  int frames = 40;
  std::optional<int> cut;  ///< the frame with which another scene begins; none: half-way, 0: no cut
  FilmMotion motion = FilmMotion::walk;
  float noise = 0;  ///< standard deviation of each channel's, in 0..255, anew in each frame and eye
};

/// A frame of a film with its exact geometry. Flow and its occlusion belong to the rays through the left view's pixel
/// centres. A pixel is occluded where its point is hidden in the other frame or outside its picture; before the first
/// frame, after the last and across a cut flow is NaN and all is occluded.
struct SyntheticFilmFrame {
  StereoPair pictures;
  StereoGeometry geometry;
  Flow to_next, to_previous;
  Image<std::uint8_t> next_occlusion, previous_occlusion;  ///< 255 where occluded
};

/// The frame, from 0, with which the second scene begins; 0 where there is no cut. Throws Error{wrong_usage} where the
/// options make no sense.
int cut_of(const SyntheticFilmOptions& options);

/// One frame, from 0, of a film of the synthetic still's table. Things carry their light with them and cast no shadow
/// while they may move: a point has one colour in every view and frame of a scene, but for what the size of pixels
/// does. The same options give the same bytes. Throws Error{wrong_usage} for options or a frame that make no sense.
SyntheticFilmFrame make_synthetic_film_frame(const SyntheticFilmOptions& options, int frame);

}  // namespace wheatstone
