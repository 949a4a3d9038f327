#pragma once

namespace wheatstone {

/// A place in a picture, in pixels: x to the right, y down, the centre of the first pixel at (½, ½).
struct PicturePoint {
  double x = 0;
  double y = 0;
};

}  // namespace wheatstone
