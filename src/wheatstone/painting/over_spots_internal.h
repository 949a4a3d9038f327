#pragma once

#include <cstdint>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/view_range.h"

namespace wheatstone {

/// The disparities that marks need to be seen over the spots, where a near mark lies in a wrong place: they must lie
/// before it. Known up to some way beyond the spots, and 0 farther away.
Image<float> disparity_before(ImageView<const float> disparity, ImageView<const std::uint8_t> spots);

/// The views that are nearer to a view than to the one halfway to the reference view, and those as far beyond.
ViewRange views_about(ViewPosition view, ViewPosition reference);

}  // namespace wheatstone
