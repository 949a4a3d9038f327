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
  /// The left eye's picture with 16 bits a channel, perhaps larger than the views are: it refines the colours of
  /// strokes. Empty: there are 8.
  ImageView<const Rgb16> left_deep = {};
};

/// Throws Error{bad_input} where a scene has no pictures, its images are not of one size, or a disparity is unknown.
void check_fits(std::span<const View> views);

/// Throws Error{bad_input} where a flow has not the size of the scene's reference view.
void check_fits(const FlowPair& flow, std::span<const View> views);

}  // namespace wheatstone
