#pragma once

#include <vector>

#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/marks/diffusion_painting.h"

namespace wheatstone {

/// A painting of lines, and what no view changes of them.
struct PreparedLines {
  DiffusionPainting painting;
  /// Lines lie a pixel beside the edges of surfaces, which are known to a pixel or two: how far from each point to the
  /// side, in pixels, it would be seen in the very view in which it was planned; 0 where it is seen itself, or nowhere
  /// near. Empty as long as nothing hides lines.
  std::vector<float> overhangs_px;

  float overhang_px(std::size_t point) const { return overhangs_px.empty() ? 0 : overhangs_px[point]; }
};

std::vector<float> overhangs_of(const DiffusionPainting& painting, const PreparedSurfaces& surfaces);

/// Lines this far beside a view still give their colours to it: otherwise colours would change all over a plain surface
/// once the line at its end leaves the view. Views of a comfortable depth shift less in five eye separations.
constexpr int diffusion_margin_px(int width) { return width / 16; }

}  // namespace wheatstone
