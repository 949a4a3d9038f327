#pragma once

#include <cstdint>
#include <span>

#include "wheatstone/image/image.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// What a touch by hand does: to the disparity of the left view, to the map that says how finely places are painted, or
/// to the strokes that are painted.
enum class Retouch {
  shift,       ///< adds `amount` pixels of disparity
  smooth,      ///< takes the mean of the surroundings, over `amount` pixels
  set,         ///< gives the disparity `amount`
  fill,        ///< gives the disparity `amount` to all that is connected in like colours, up to its rim
  shift_area,  ///< adds `amount` pixels of disparity in the area that this touch and those that go on go around
  set_area,    ///< gives such an area the disparity `amount`
  detail,      ///< adds `amount` levels to the detail map
  paint,       ///< a stroke through this touch and those that go on, of `colour`
  erase,       ///< takes strokes away
  recolour,    ///< gives strokes `colour`
};

enum class Retouched { depth, detail, strokes };
constexpr Retouched retouched_by(Retouch kind) {
  if (kind == Retouch::detail) return Retouched::detail;
  return kind < Retouch::detail ? Retouched::depth : Retouched::strokes;
}

/// Whether it needs all touches of a stroke of the hand.
constexpr bool is_lasso(Retouch kind) { return kind == Retouch::shift_area || kind == Retouch::set_area; }

/// One touch of a round brush: whole within half its radius, less towards its rim.
struct Touch {
  Retouch kind = Retouch::shift;
  float x = 0, y = 0;    ///< of its middle, in pixels of the left view
  float radius_px = 20;  ///< above 0; fills and areas have none
  float amount = 0;      ///< as the kind says
  Rgb8 colour = {};      ///< of strokes
  bool goes_on = false;  ///< it belongs to the same stroke of the hand as the touch before it
  friend bool operator==(const Touch&, const Touch&) = default;
};

/// Does the touches of depth to the left view's disparity, in their order. `picture` is the left
/// photograph, of the same size, in which fills find what is connected: neighbours that differ by at most 6 levels a
/// channel from each other, and by 40 from where the fill begins; gaps of up to 4 pixels, as of a wire, are filled,
/// too. An area goes back from the last touch around it to the first on a straight line; what is gone around twice is
/// not in it. Every disparity is known. Touches beside the picture do nothing, but for areas that reach into it.
/// `progress` is called before each touch; what it throws ends it.
void retouch_disparity(std::span<const Touch> touches, ImageView<const Rgb8> picture, Image<float>& disparity,
                       const Progress& progress = {});

/// Does those of detail to a map of View::detail.
void retouch_detail(std::span<const Touch> touches, Image<std::uint8_t>& detail);

}  // namespace wheatstone
