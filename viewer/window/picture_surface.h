#pragma once

#include <QImage>
#include <QWidget>
#include <memory>

#include "viewer/compose.h"
#include "viewer/frame_geometry.h"

namespace wheatstone::viewer {

/// Shows frames, one pixel of a frame on one of the screen.
class PictureSurface {
 public:
  virtual ~PictureSurface() = default;
  virtual QWidget* widget() = 0;
  /// What the pointer's events come to.
  virtual QObject* pointed_at() { return widget(); }
  virtual void show(const Frame& frame) = 0;
  virtual bool uses_opengl() const { return false; }
};

/// Draws by OpenGL 4.5 where there is any, and by the processor otherwise; `why_not` then says why, for people.
std::unique_ptr<PictureSurface> make_surface(bool with_opengl, QString& why_not);

/// The widget's place on its screen, in the screen's own pixels.
Viewport viewport_of(const QWidget& widget);

}  // namespace wheatstone::viewer
