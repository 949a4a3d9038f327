#pragma once

#include <cstdint>

#include "wheatstone/image/image.h"
#include "wheatstone/image/known_runs.h"

namespace wheatstone {

/// Disparities in steps of a sixteenth of a pixel, in which they are compared; those beyond ± 2047 pixels count as
/// 2047.
Image<std::int16_t> disparity_in_steps(ImageView<const float> disparity);

/// 255 for every pixel whose (2R+1)² window holds a disparity that differs from its own by more than `threshold_px`:
/// a brush of radius R set down there would spill paint onto another surface (Stavrakis & Gelautz 2005, sec. 3.2).
Image<std::uint8_t> near_depth_edge(ImageView<const std::int16_t> steps, float radius_px, float threshold_px);

/// Distance in pixels from each pixel's centre to the nearest depth edge, 0.5 for the pixels on either side of one;
/// unknown where it is `most_px`, at most 240, or more.
KnownRuns distance_to_depth_edge(ImageView<const std::int16_t> steps, float threshold_px, float most_px);

/// 255 for every pixel that has a surface nearer than its own by more than `threshold_px` within `reach_px`. A camera
/// mixes the two surfaces' colours there, and disparity maps are least to be trusted: a stroke of that colour would
/// carry a rim of the near object away with the far one.
Image<std::uint8_t> behind_depth_edge(ImageView<const std::int16_t> steps, float reach_px, float threshold_px);

// The kernels of the functions above.

/// Which pixels near_depth_edge or behind_depth_edge marks.
struct DepthEdgeMarks {
  ImageView<const std::int16_t> steps;
  int reach_px;
  std::int16_t threshold;  ///< in steps
  bool only_behind;
};
void mark_depth_edges(const DepthEdgeMarks& wanted, int first_row, int end_row, Image<std::uint8_t>& marks);

/// Lengths of the steps of a distance transform with a mask of three by three pixels, by which its largest error is
/// least (Borgefors 1986): a path has as many steps aslant as it can.
struct ChamferSteps {
  static constexpr int one_px = 1 << 16;
  static constexpr int straight = 62587, diagonal = 89738;  // 0.955 px and 1.3693 px
};

/// Distances from some rows of a mask to its nearest pixel that is 255, plus half a pixel; NaN from `most_px` on.
/// `distances` holds these rows alone.
void measure_edge_distances(ImageView<const std::uint8_t> edges, float most_px, int first_row,
                            ImageView<float> distances);

}  // namespace wheatstone
