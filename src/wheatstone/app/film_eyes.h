#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/gpu/device.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/stereo/reduced_pair.h"

namespace wheatstone {

/// How two eyes look at the frames of a film's scene.
struct FilmEyes {
  float separation = 1;        ///< in the film's own eye separations, at most 1
  float zero_parallax_px = 0;  ///< disparity, in pixels of the film, that comes to lie on the screen
  Placement placement;         ///< that draws them so; the part that both eyes show fills the frame
};

/// Whether they are other eyes than the film's own.
bool are_moved(const FilmEyes& eyes);

/// Eyes near enough together for the scene, from its farthest point to its nearest, to take no more than `depth_budget`
/// of the width; a third of that before the screen and two thirds behind it, as broadcasters allow it. The film's own
/// screen plane is kept as far as that lets it. Of a scene that fits, they are the film's own.
FilmEyes comfortable_eyes(PictureSize frame, const DepthEnds& ends, float depth_budget);

/// A frame's picture for either eye; `bare_share` of the worse one.
struct FilmEyePictures {
  Image<Rgb8> left, right;
  double left_bare_share = 0, right_bare_share = 0;
};
FilmEyePictures draw_for_eyes(const Painting& painting, const FilmEyes& eyes, Device device = Device::processor);

/// What a film says of itself whose eyes were moved in so many frames, at least so near together: a sentence.
std::string moved_eyes_note(std::int64_t frames, double least_separation);

/// Whether a film says so.
bool tells_moved_eyes(std::string_view comment);

}  // namespace wheatstone
