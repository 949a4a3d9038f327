#pragma once

#include <optional>

#include "wheatstone/motion/flow.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {

enum class FilmScene {
  still_life,  ///< the synthetic still's table, in the motion asked for
  beams,       ///< thin bars before a wall; the camera passes them fast, and each frame is exposed for half its time
  still,       ///< the table of the still life; nothing moves
  crowd        ///< many little figures that cross the table both ways, each at its own speed
};

/// How the still life moves.
enum class FilmMotion {
  walk,  ///< the camera moves about and turns, and the fruit beside the bowl hops, slides and turns
  pan    ///< the camera only turns, slowly; nothing else moves
};

struct SyntheticFilmOptions {
  /// The scene, the size of the views and their disparities; fine texture flickers where samples are few.
  SyntheticStillOptions still{.width = 960, .height = 540, .samples_a_side = 4};
  int frames = 40;
  /// The frame with which another scene begins, 0: no cut; none: half-way in the still life, no cut in other scenes.
  std::optional<int> cut;
  FilmScene scene = FilmScene::still_life;
  FilmMotion motion = FilmMotion::walk;  ///< of the still life
  /// Standard deviation of each channel's noise, in 0..255, anew in each frame and eye; none: 3 in the scene in which
  /// nothing moves, 0 in others.
  std::optional<float> noise;
};

/// A frame of a film with its exact geometry. Flow and its occlusion belong to the rays through the left view's pixel
/// centres. A pixel is occluded where its point is hidden in the other frame or outside its picture; before the first
/// frame, after the last and across a cut flow is NaN and all is occluded. Where a frame is exposed for some time,
/// geometry and flow are those of the middle of it.
struct SyntheticFilmFrame {
  StereoPair pictures;
  StereoGeometry geometry;
  Flow to_next, to_previous;
  Image<std::uint8_t> next_occlusion, previous_occlusion;  ///< 255 where occluded
};

/// The frame, from 0, with which the second scene begins; 0 where there is no cut. Throws Error{wrong_usage} where the
/// options make no sense.
int cut_of(const SyntheticFilmOptions& options);

/// One frame, from 0, of a synthetic film. Things carry their light with them and cast no shadow
/// while they may move: a point has one colour in every view and frame of a scene, but for what the size of pixels
/// does. The same options give the same bytes. Throws Error{wrong_usage} for options or a frame that make no sense.
SyntheticFilmFrame make_synthetic_film_frame(const SyntheticFilmOptions& options, int frame);

}  // namespace wheatstone
