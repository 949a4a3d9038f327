#pragma once

#include <string>

#include "wheatstone/marks/brush_picture.h"

namespace wheatstone {

/// A built-in brush by its name, "none", or any picture by its path: its lightness is the cover, reduced or enlarged to
/// the size of a brush's picture. Throws Error{wrong_usage} where it is neither, which lists the names, and
/// Error{bad_input} where it cannot be read or is black.
BrushPicture read_brush(const std::string& name_or_path);

}  // namespace wheatstone
