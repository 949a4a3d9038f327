#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone {

/// The views of a rig from slices, without the particles (Hassaine 2010, sec. 5.5, 6.2). The rig's size is the stack's.
/// Slices with alpha hide what is behind them; a pixel that is full is not looked at further (sec. 6.4, 6.5.1). Throws
/// Error{wrong_usage} where the focus would fold a view.
std::vector<Image<Rgb8>> render_slices(const SliceStack& stack, const Rig& rig,
                                       SliceFilter filter = SliceFilter::centroid, const Progress& progress = {},
                                       const std::optional<Focus>& focus = {});

/// Fills in which view each sub-pixel of a row shows: three for each pixel, red, green, blue.
using ViewsOfRow = std::function<void(int y, std::span<std::uint16_t> three_per_pixel)>;

/// The picture for a screen that shows another view in every sub-pixel, of the size of the stack: each sub-pixel is
/// composited for its own view, and no other is (sec. 6.5.2).
struct InterleavedView {
  Image<Rgb8> picture;
  std::uint64_t composited = 0;  ///< sub-pixels
};
InterleavedView render_interleaved(const SliceStack& stack, std::span<const ViewPosition> views,
                                   const ViewsOfRow& views_of_row, const Progress& progress = {},
                                   const std::optional<Focus>& focus = {});

/// Moves every slice: the parallaxes' range becomes the one given, in pixels. For another display, or less depth.
void map_depth(SliceStack& stack, float nearest_px, float farthest_px);

/// Moves every slice to where the regions have it, of which share 0 is the nearest slice and 1 the farthest; shares
/// count parallax. Throws as disparity_mapping. The view is as wide as the screen; `viewing.width_px` is not read.
void map_depth(SliceStack& stack, std::span<const DepthRegion> regions, ViewingGeometry viewing);

}  // namespace wheatstone
