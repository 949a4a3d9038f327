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

/// Draws a scale bar, the colours with their numbers and units, and the redshift of a snapshot into views, all of one
/// size, at the depth of the screen: in the same place of each. The bar's length is that at the depth that the camera
/// looks at. Says, in words for people, what is left out of views that are too small for it, and why there are no
/// numbers. Throws as font_for (display/lettering.h).
std::vector<std::string> annotate(const RenderedParticles& rendered, std::span<Image<Rgb8>> views,
                                  ShownAs shown_as = ShownAs::still);

/// Throws as `annotate` where no font of this machine has its letters: to be known before long work.
void check_annotation_font();

/// The longest of 1, 2 or 5 times a power of ten that is not longer than `most` > 0.
double round_length(double most);

}  // namespace wheatstone
