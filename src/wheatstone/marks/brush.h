#pragma once

namespace wheatstone {

/// How a brush's bristles leave their paint. Without bristles a stroke is an even disc along its curve, as in the
/// papers. What a bristle leaves belongs to the stroke, by a hash of its number: it is the same in all views, and stays
/// on the stroke from frame to frame.
struct Brush {
  float bristle_px =
      0;              ///< width that a bristle leaves, in pixels of the painting; wide strokes have wider ones; 0: none
  float streaks = 0;  ///< levels, of 255, by which the paint of a bristle may be lighter or darker
  float ridge = 0;    ///< levels by which the paint at a stroke's rim is lighter or darker, lit from the upper left
  float dry = 0;      ///< share of a stroke's length, 0..1, before whose end a bristle may run out of paint
  friend bool operator==(const Brush&, const Brush&) = default;
};

}  // namespace wheatstone
