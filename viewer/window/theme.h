#pragma once

#include <QPalette>

#include "viewer/session.h"

namespace wheatstone::viewer {

/// The palette of a theme; of the desktop's, the one that the program began with.
QPalette palette_of(Theme theme, const QPalette& of_desktop);

}  // namespace wheatstone::viewer
