#pragma once

#include <optional>
#include <vector>

#include "wheatstone/depth/view_position.h"

namespace wheatstone::viewer {

/// The place in which a picture is shown: of a window, on its screen.
struct Viewport {
  int width = 0, height = 0;       ///< pixels
  int screen_x = 0, screen_y = 0;  ///< of its upper left pixel on the screen
  friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// Where a view lies in a frame: pixel (x, y) of the view at frame pixel
/// left + squeeze_x · (origin_x + scale · x), top + squeeze_y · (origin_y + scale · y), but for the eyes' roll.
struct ViewPlace {
  ViewPosition view;
  int left = 0, top = 0, width = 0, height = 0;  ///< of the frame, that shows the view
  double squeeze_x = 1, squeeze_y = 1;           ///< ½ where half of an eye's pixels are left out
  double scale = 1;
  double origin_x = 0, origin_y = 0;
};

/// A place in a view, in its own pixels.
struct PlaceInView {
  ViewPosition view;
  double x = 0, y = 0;
};

/// What lies at a pixel of a frame; none beside the views.
std::optional<PlaceInView> place_at(const std::vector<ViewPlace>& places, double x, double y);

}  // namespace wheatstone::viewer
