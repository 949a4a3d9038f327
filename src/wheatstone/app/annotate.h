#pragma once

#include <span>
#include <string>
#include <vector>

#include "wheatstone/app/render_particles.h"

namespace wheatstone {

/// Where annotations are read, which sets their size.
enum class ShownAs {
  still,
  film,  ///< larger: it is seen from farther away, and for a moment
};

struct Annotation {
  std::string title;    ///< at the top in the middle; empty: none
  float behind_mm = 0;  ///< depth of all that is drawn, behind the screen; in front of it where negative
  ShownAs shown_as = ShownAs::still;
};

/// Draws a scale bar, the colours with their numbers and units, or those of types with their names, the redshift or
/// the time of a snapshot and a title into the views of `rendered.rig`, all of one size, at one depth, to the nearest
/// pixel. The bar's length is that at the depth that the camera looks at. Says, in words for people, what is left out
/// of views that are too small for it, and why there are no numbers. Throws as check_annotation.
std::vector<std::string> annotate(const RenderedParticles& rendered, std::span<Image<Rgb8>> views,
                                  const Annotation& annotation = {});

/// What is wrong is to be known before long work: throws as font_for (display/lettering.h) where no font of this
/// machine has the letters, Error{wrong_usage} for a depth that is not in front of the viewer.
void check_annotation(const Annotation& annotation, const ViewingGeometry& viewing);

/// The longest of 1, 2 or 5 times a power of ten that is not longer than `most` > 0.
double round_length(double most);

}  // namespace wheatstone
