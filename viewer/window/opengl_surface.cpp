#include "opengl_surface.h"

#include <QOpenGLWidget>
#include <optional>
#include <utility>

#include "frame_texture.h"

namespace wheatstone::viewer {
namespace {

/// One texture over the whole widget.
class OpenglSurface final : public QOpenGLWidget, public PictureSurface {
 public:
  OpenglSurface() { setFormat(opengl_format()); }
  ~OpenglSurface() override {
    if (!texture_) return;
    makeCurrent();
    texture_.reset();
    doneCurrent();
  }
  QWidget* widget() override { return this; }
  bool uses_opengl() const override { return texture_.has_value(); }

  void show(const Frame& frame) override {
    picture_ = frame.picture;
    is_new_ = true;
    update();
  }

 protected:
  void initializeGL() override {
    texture_.emplace(*context());
    is_new_ = !picture_.empty();
  }

  void paintGL() override {
    if (!texture_) return;
    if (std::exchange(is_new_, false)) texture_->upload(picture_);
    texture_->draw();
  }

 private:
  std::optional<FrameTexture> texture_;
  Image<Rgb8> picture_;
  bool is_new_ = false;
};

}  // namespace

QSurfaceFormat opengl_format() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CoreProfile);
  return format;
}

std::unique_ptr<PictureSurface> make_opengl_surface() { return std::make_unique<OpenglSurface>(); }

}  // namespace wheatstone::viewer
