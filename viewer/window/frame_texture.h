#pragma once

#include <QSize>
#include <memory>

#include "wheatstone/image/image.h"

class QOpenGLContext;
class QOpenGLFunctions_4_5_Core;
class QOpenGLShaderProgram;

namespace wheatstone::viewer {

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

}  // namespace wheatstone::viewer
