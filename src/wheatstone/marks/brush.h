#pragma once

#include <algorithm>

#include "wheatstone/marks/brush_picture.h"

namespace wheatstone {

/// How a brush leaves its paint. Without bristles a stroke is an even disc along its curve, as in the
/// papers. What a bristle leaves belongs to the stroke, by a hash of its number: it is the same in all views, and stays
/// on the stroke from frame to frame.
struct Brush {
  float bristle_px = 0;  ///< least width that a bristle leaves, in pixels of the painting: a sixth of the stroke's
                         ///< radius where that is more; 0: no bristles, unless there is a picture
  float streaks = 0;     ///< levels, of 255, by which the paint of a bristle may be lighter or darker
  float ridge = 0;       ///< levels by which the paint at a stroke's rim is lighter or darker, lit from the upper left
  float dry = 0;         ///< share of a stroke's length, 0..1, before whose end a bristle may run out of paint
  /// Stretched over strokes that are longer than wide; those of a radius below 3 px show less of it. Where it is dark,
  /// the paint of a brush that runs dry leaves the ground bare, and is darker in the measure of the streaks.
  BrushPicture picture = {};

  /// Whether its paint is not the same everywhere in a stroke.
  bool varies() const { return bristle_px > 0 || !picture.empty(); }
  friend bool operator==(const Brush&, const Brush&) = default;
};

/// Width of what the bristles leave on a stroke of this radius: a bundle of them leaves one streak of a wide brush.
inline float streak_width_px(float bristle_px, float radius_px) { return std::max(bristle_px, radius_px / 6); }

/// The brush of a painting's coarsest layer, which is the ground of the others: it covers all of its strokes.
inline Brush ground_brush(Brush brush) {
  brush.dry = 0;
  return brush;
}

/// The brush: a disc whose cover falls from 1 to 0 across a soft rim a tenth of its radius wide, but never less than a
/// pixel, which is the antialiasing. Half cover lies at 0.95 R, the middle of the rim.
struct BrushProfile {
  explicit BrushProfile(float radius_px)
      : rim_px(radius_px > 10 ? 0.1f * radius_px : 1.f),
        middle_px(0.95f * radius_px),
        reach_px(middle_px + rim_px / 2) {}
  float rim_px;
  float middle_px;
  float reach_px;  ///< cover is 0 from here on

  float cover(float distance_px) const {
    const float c = (middle_px - distance_px) / rim_px + 0.5f;
    return c < 0 ? 0 : c > 1 ? 1 : c;
  }
};

}  // namespace wheatstone
