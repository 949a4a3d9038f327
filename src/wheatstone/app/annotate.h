#pragma once

#include <span>
#include <string>

#include "wheatstone/app/render_particles.h"

namespace wheatstone {

/// Draws a scale bar, the colours with their limits and units, and the redshift of a snapshot into views, at the depth
/// of the screen: in the same place of each. The bar's length is that at the depth that the camera looks at. Items that
/// do not fit into small views are left out.
void annotate(const RenderedParticles& rendered, std::span<Image<Rgb8>> views);

/// The longest of 1, 2 or 5 times a power of ten that is not longer than `most` > 0.
double round_length(double most);

}  // namespace wheatstone
