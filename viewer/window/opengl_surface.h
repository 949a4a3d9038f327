#pragma once

#include <QSurfaceFormat>
#include <memory>

#include "picture_surface.h"

namespace wheatstone::viewer {

/// OpenGL 4.5 core.
QSurfaceFormat opengl_format();

std::unique_ptr<PictureSurface> make_opengl_surface();

}  // namespace wheatstone::viewer
