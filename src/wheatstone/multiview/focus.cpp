#include "wheatstone/multiview/focus.h"

#include <fmt/format.h>

#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {

void check_focus(const Focus& focus, float largest_shift_px) {
  // The steepest slope of (1 − u²)² is 8 / √27, at u = 1/√3.
  constexpr float steepest = 1.5396007f;
  const float least_radius = steepest * std::abs(focus.gain - 1) * largest_shift_px;
  if (!(focus.radius_px > least_radius))
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("--focus-radius: is {:.0f} pixels, expected more than {:.0f}, so that a gain of {} does not "
                    "fold views that are shifted by up to {:.0f} pixels",
                    focus.radius_px, least_radius, focus.gain, largest_shift_px));
  constexpr float most_moved = 96;  // what a block of pixels is read with around it
  if (std::abs(focus.gain - 1) * largest_shift_px > most_moved)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--focus-gain: is {}, expected at most {:.2f} for views that are shifted by up to {:.0f} "
                            "pixels",
                            focus.gain, 1 + most_moved / largest_shift_px, largest_shift_px));
}

}  // namespace wheatstone
