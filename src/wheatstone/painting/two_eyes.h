#pragma once

#include <optional>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {

/// How two eyes look at a painting: by default as those for which it was made.
struct TwoEyes {
  float separation = 1;        ///< in the painting's own eye separations, at most 1
  float zero_parallax_px = 0;  ///< disparity, in pixels of the painting, that comes to lie on the screen
  Placement placement;         ///< that draws them so; the part that both eyes show fills the picture
};

/// Whether they are other eyes than the painting's own.
bool are_moved(const TwoEyes& eyes);

/// Shows a painting to two eyes, the left one first.
Presentation for_two_eyes(const TwoEyes& eyes = {});

/// Shows it to its own eyes and, if `separation` is less than 1, also to eyes at that separation. The last two views
/// are the ones for viewing. Four views that are drawn together cost less than two pairs.
Presentation for_own_and_nearer_eyes(float separation);

/// The separation of two eyes that look at a painting, in its own eye separations, at most 1. With it, the disparities
/// from the scene's farthest point to its nearest, without outliers, take at most `depth_budget` of the width. 1 if
/// there is no budget, or the painting has no surfaces.
float comfortable_separation(const Painting& painting, std::optional<float> depth_budget);

/// Eyes so near together that a film's scene, from its farthest point to its nearest, takes at most `depth_budget` of
/// the width: a third of it before the screen and two thirds behind it, as broadcasters allow. The film's own screen
/// plane is kept as far as this permits, unless a disparity is given that lies on the screen plane. If the scene fits
/// already, the eyes are the film's own.
TwoEyes comfortable_eyes(PictureSize frame, const DepthEnds& ends, float depth_budget,
                         std::optional<float> zero_parallax_px = {});

/// The disparity of the nearest mark, without outliers; 0 if there are no marks.
float nearest_disparity(const Painting& painting);

}  // namespace wheatstone
