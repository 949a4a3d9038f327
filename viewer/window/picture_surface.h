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

/// Whether pictures are shown by OpenGL.
enum class OpenglUse {
  where_fast,  ///< but not where the processor computes it, which takes longer than doing without
  always,
  never,
};

/// Shows pictures by OpenGL 4.5 where that is wanted and there is any, and without it otherwise. `why_not` says why
/// there is none, for people; empty where nothing is missing.
std::unique_ptr<PictureSurface> make_surface(OpenglUse use, QString& why_not);

/// The widget's place on its screen, in the screen's own pixels.
Viewport viewport_of(const QWidget& widget);

}  // namespace wheatstone::viewer
