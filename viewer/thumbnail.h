#pragma once

#include "session.h"
#include "wheatstone/image/image.h"

namespace wheatstone::viewer {

/// A small picture of what files hold: the left eye's. Empty where they hold none that is quickly made: particles,
/// films, and what cannot be read. Reads files: not for the window's thread.
Image<Rgb8> thumbnail_of(const Item& files, PictureSize largest);

}  // namespace wheatstone::viewer
