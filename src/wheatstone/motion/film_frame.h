#pragma once

#include <span>

#include "wheatstone/motion/flow.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// One frame of a film, as marks are made from it. Borrows what it points to.
struct FilmFrame {
  std::span<const View> views;  ///< the reference view first
  /// Of the reference view: forward, of the pixels of the frame before, to this one; backward, of this one's pixels,
  /// to the one before. Null where a scene begins: nothing is carried into it.
  const FlowPair* flow = nullptr;
};

}  // namespace wheatstone
