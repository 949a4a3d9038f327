#pragma once

#include <cmath>
#include <limits>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// What hides marks in one view. Surfaces are of the picture's size, NaN where none is known; empty ones hide nothing.
///
/// Marks planned in the reference view lie on surfaces visible in it. Marks planned in another view are seen where the
/// reference view shows nothing, or something farther; elsewhere they only fill pixels that the reference view's marks
/// leave bare.
struct Hiding {
  ImageView<const float> surface;    ///< the nearest
  ImageView<const float> reference;  ///< the reference view's alone; empty: all marks are its own
  float tolerance_px = 0;            ///< of disparity, by which a surface must lie before a mark
  ViewPosition reference_view;
  ImageView<const float> photographed;  ///< the nearest that photographs show; of all views where that is empty
  ViewRange photographed_views;         ///< marks of other views go on where no photograph shows anything
  int first_row = 0;                    ///< row of the picture that is the surfaces' first row

  bool is_continued(ViewPosition planned_in) const {
    return !photographed.empty() && !photographed_views.contains(planned_in);
  }
  bool is_own(ViewPosition planned_in) const { return reference.empty() || planned_in == reference_view; }
};

// The least disparity with which a mark is seen at a pixel.

inline float least_seen_disparity(float surface, float tolerance_px) {
  constexpr float anything = -std::numeric_limits<float>::infinity();
  return std::isnan(surface) ? anything : surface - tolerance_px;
}

/// Whether the reference view shows the nearest surface.
inline bool is_of_reference(float surface, float reference, float tolerance_px) {
  return !std::isnan(reference) && surface <= reference + tolerance_px;
}

/// The least disparity of a mark that was planned in another view than the reference.
inline float least_seen_of_other(float surface, float reference, float tolerance_px) {
  constexpr float nothing = std::numeric_limits<float>::infinity();
  return is_of_reference(surface, reference, tolerance_px) ? nothing : least_seen_disparity(surface, tolerance_px);
}

/// Whether surfaces hide a mark of this disparity at a place, in pixels.
inline bool is_hidden(float x, float y, float disparity, ViewPosition planned_in, const Hiding& hiding) {
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y)) - hiding.first_row;
  if (!hiding.surface.contains(column, row)) return false;
  const float surface = hiding.surface(column, row);
  if (hiding.is_own(planned_in)) return disparity < least_seen_disparity(surface, hiding.tolerance_px);
  const ImageView<const float>& known = hiding.is_continued(planned_in) ? hiding.photographed : hiding.reference;
  return disparity < least_seen_of_other(surface, known(column, row), hiding.tolerance_px);
}

}  // namespace wheatstone
