#pragma once

#include <memory>

#include "picture_surface.h"

namespace wheatstone::viewer {

/// Shows a frame's pictures of the left and the right eye in turn, by a graphics card with stereo (quad buffers); of a
/// frame with one picture, that. Throws Error{cannot_read_write} where the driver has none.
std::unique_ptr<PictureSurface> make_stereo_surface();

}  // namespace wheatstone::viewer
