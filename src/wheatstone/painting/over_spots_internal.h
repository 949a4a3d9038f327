#pragma once

#include <cstdint>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// The disparities with which marks are seen over the spots: a near mark lies there in a wrong place, and they must lie
/// before it. Valid up to some distance beyond the spots, and 0 farther away.
Image<float> disparity_before(ImageView<const float> disparity, ImageView<const std::uint8_t> spots);

/// The views that are nearer to a view than to the one halfway to the reference view, and those as far beyond.
ViewRange views_about(ViewPosition view, ViewPosition reference);

}  // namespace wheatstone
