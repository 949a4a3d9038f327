#pragma once

#include <optional>

#include "wheatstone/depth/comfort.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// The meaning of the numbers in a picture of depth.
enum class DepthKind {
  inverse,  ///< a disparity up to scale and offset, larger is nearer: monocular networks, most pictures of depth
  metric    ///< a length along the line of sight in any unit, larger is farther; 0 and below are unknown
};

/// Inverse depths, of any scale and offset, of a scene's farthest and nearest points.
struct InverseDepthRange {
  float farthest = 0, nearest = 0;
};

/// The range of a picture of depth, without half a percent of outliers on either side. Nothing if the depth is the same
/// everywhere, or unknown.
std::optional<InverseDepthRange> inverse_depth_range(ImageView<const float> depth, DepthKind kind);

struct DisparityFromDepthOptions {
  DepthKind kind = DepthKind::inverse;
  float strength = comfortable_parallax_share;  ///< disparity from the farthest point to the nearest, in widths
  std::optional<InverseDepthRange> range;       ///< of the farthest and the nearest point; none: the picture's own
};

/// The disparity of one picture from its depth, in pixels of the picture: 0 at the farthest point, `strength` of the
/// width at the nearest. Half a percent of outliers on either side get the same disparities as these points. Unknown
/// depths (not finite) take the farther one of their neighbours on the scan line. Depth of another size is resampled:
/// between pixels of one surface linearly, and at a depth edge by the pixel whose colour is nearest. Ramps across a
/// depth edge that are too steep for a surface become steps. Where no range is given and the depth is the same
/// everywhere, so is the disparity: 0. Throws Error{bad_input} where the depth's shape differs from the picture's by
/// more than 1 %, or nothing is known; Error{wrong_usage} for a strength that is not in (0, 1).
Image<float> disparity_from_depth(ImageView<const float> depth, ImageView<const Rgb8> picture,
                                  const DisparityFromDepthOptions& options = {});

}  // namespace wheatstone
