#pragma once

#include <functional>
#include <span>

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/regions/region_map_internal.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// A view whose regions are cut: its disparity is without outliers, and what is wanted of it is grown.
struct ViewToCut : View {
  std::size_t number = 0;  ///< of the view in its scene; 0 is the reference view
  ViewRange views;         ///< in which its marks may be drawn
  std::uint64_t seed = 1;
  float scale = 1;               ///< pixels for one of a picture 640 pixels wide
  float depth_threshold_px = 2;  ///< T_depth in pixels of this picture
};

/// Appends one view's marks, in any order and in its own pixels.
using CutView = std::function<void(const ViewToCut&, const Style&, RegionPainting&)>;

/// Cuts the reference view into marks that all views show, then what only each other view sees into marks of its own;
/// or, where the style says so, each view for itself. Views are of the reference view's scale. Throws Error{bad_input}
/// where there is no view or a view's images do not fit together, wrong_usage for a style that cannot be painted with.
RegionPainting plan_regions(std::span<const View> views, const Style& style, const CutView& cut);

}  // namespace wheatstone
