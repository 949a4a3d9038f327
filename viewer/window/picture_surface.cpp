#include "picture_surface.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPainter>
#include <QScreen>
#include <cmath>

#include "opengl_surface.h"

namespace wheatstone::viewer {
namespace {

class PaintedSurface final : public QWidget, public PictureSurface {
 public:
  PaintedSurface() { setAttribute(Qt::WA_OpaquePaintEvent); }
  QWidget* widget() override { return this; }
  void show(const Frame& frame) override {
    const Image<Rgb8>& picture = frame.picture;
    image_ = QImage(reinterpret_cast<const uchar*>(picture.pixels().data()), picture.width(), picture.height(),
                    picture.width() * 3, QImage::Format_RGB888)
                 .copy();
    update();
  }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    painter.fillRect(rect(), Qt::black);
    image_.setDevicePixelRatio(devicePixelRatioF());
    painter.drawImage(0, 0, image_);
  }

 private:
  QImage image_;
};

/// The OpenGL that there is.
struct FoundOpengl {
  QString problem;  ///< empty where OpenGL 4.5 works
  bool is_fast = false;
};

FoundOpengl find_opengl() {
  QOpenGLContext context;
  context.setFormat(opengl_format());
  if (!context.create()) return {"OpenGL is not available"};
  QOffscreenSurface surface;
  surface.setFormat(context.format());
  surface.create();
  if (!context.makeCurrent(&surface)) return {"OpenGL is not available"};
  const auto [major, minor] = context.format().version();
  const QString renderer(reinterpret_cast<const char*>(context.functions()->glGetString(GL_RENDERER)));
  context.doneCurrent();
  if (major < 4 || (major == 4 && minor < 5))
    return {QString("OpenGL %1.%2 is too old, 4.5 is needed").arg(major).arg(minor)};
  // Mesa's drivers without a graphics card.
  const bool by_processor = renderer.contains("llvmpipe") || renderer.contains("softpipe");
  return {{}, !by_processor};
}

}  // namespace

std::unique_ptr<PictureSurface> make_surface(OpenglUse use, QString& why_not) {
  if (use != OpenglUse::never) {
    const FoundOpengl found = find_opengl();
    why_not = found.problem;
    if (found.problem.isEmpty() && (found.is_fast || use == OpenglUse::always)) return make_opengl_surface();
  }
  return std::make_unique<PaintedSurface>();
}

Viewport viewport_of(const QWidget& widget) {
  const double ratio = widget.devicePixelRatioF();
  const auto pixels = [ratio](int length) { return static_cast<int>(std::lround(length * ratio)); };
  const QPoint place = widget.mapToGlobal(QPoint(0, 0)) - widget.screen()->geometry().topLeft();
  return {pixels(widget.width()), pixels(widget.height()), pixels(place.x()), pixels(place.y())};
}

}  // namespace wheatstone::viewer
