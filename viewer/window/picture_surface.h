#pragma once

#include <QImage>
#include <QSize>
#include <QSurfaceFormat>
#include <QWidget>
#include <memory>

#include "viewer/compose.h"
#include "wheatstone/image/image.h"

class QOpenGLContext;
class QOpenGLFunctions_4_5_Core;
class QOpenGLShaderProgram;

namespace wheatstone::viewer {

/// A picture for widgets, copied.
QImage qimage_of(const Image<Rgb8>& picture);

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

/// A picture on the graphics card, drawn pixel on pixel. All functions are for where the context that it was made in is
/// current.
class FrameTexture {
 public:
  /// Throws Error{cannot_read_write} where the context is not of OpenGL 4.5.
  explicit FrameTexture(QOpenGLContext& context);
  ~FrameTexture();
  FrameTexture(const FrameTexture&) = delete;
  FrameTexture& operator=(const FrameTexture&) = delete;

  void upload(ImageView<const Rgb8> picture);
  /// Over the whole of what is drawn to, black beside the picture.
  void draw();
  QOpenGLFunctions_4_5_Core& functions() { return functions_; }

 private:
  QOpenGLFunctions_4_5_Core& functions_;
  std::unique_ptr<QOpenGLShaderProgram> program_;
  unsigned texture_ = 0, nothing_ = 0;
  QSize size_;
};

/// OpenGL 4.5 core.
QSurfaceFormat opengl_format();

std::unique_ptr<PictureSurface> make_opengl_surface();

/// Shows a frame's pictures of the left and the right eye in turn, by a graphics card with stereo (quad buffers); of a
/// frame with one picture, that. Throws Error{cannot_read_write} where the driver has none.
std::unique_ptr<PictureSurface> make_stereo_surface();

}  // namespace wheatstone::viewer
