#pragma once

#include <vector>

#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/marks/diffusion_painting.h"

namespace wheatstone {

/// A painting of lines, and what no view changes of them.
struct PreparedLines {
  DiffusionPainting painting;
  /// For each point, the offset along the row, in pixels, at which it would be seen in the view where it was planned; 0
  /// if the point itself is seen, or no place near it. Lines need it because they lie a pixel beside the edges of
  /// surfaces, which are known only to a pixel or two. Empty as long as nothing hides lines.
  std::vector<float> overhangs_px;

  float overhang_px(std::size_t point) const { return overhangs_px.empty() ? 0 : overhangs_px[point]; }
};

std::vector<float> overhangs_of(const DiffusionPainting& painting, const Surfaces& surfaces);

/// Lines this far beside a view still give their colours to it: otherwise colours would change all over a plain surface
/// once the line at its end leaves the view. Views of a comfortable depth shift less in five eye separations.
constexpr int diffusion_margin_px(int width) { return width / 16; }

}  // namespace wheatstone
