#include "stereo_surface.h"

#include <QOpenGLContext>
#include <QOpenGLFunctions_4_5_Core>
#include <QOpenGLWindow>
#include <array>
#include <optional>
#include <utility>

#include "frame_texture.h"
#include "opengl_surface.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

QSurfaceFormat stereo_format() {
  QSurfaceFormat format = opengl_format();
  format.setStereo(true);
  format.setSwapBehavior(QSurfaceFormat::DoubleBuffer);
  return format;
}

/// A native window, because widgets are drawn into a texture, which has no buffer for each eye.
class StereoWindow final : public QOpenGLWindow {
 public:
  StereoWindow() { setFormat(stereo_format()); }
  ~StereoWindow() override {
    if (!textures_[0]) return;
    makeCurrent();
    for (auto& texture : textures_) texture.reset();
    doneCurrent();
  }

  void show_frame(const Frame& frame) {
    pictures_ = {frame.picture, frame.right};
    is_new_ = true;
    update();
  }

 protected:
  void initializeGL() override {
    for (auto& texture : textures_) texture.emplace(*context());
    is_new_ = !pictures_[0].empty();
  }

  void paintGL() override {
    if (!textures_[0]) return;
    if (std::exchange(is_new_, false))
      for (std::size_t eye = 0; eye < 2; ++eye)
        if (!pictures_[eye].empty()) textures_[eye]->upload(pictures_[eye]);
    constexpr std::array<GLenum, 2> buffers{GL_BACK_LEFT, GL_BACK_RIGHT};
    for (std::size_t eye = 0; eye < 2; ++eye) {
      textures_[eye]->functions().glDrawBuffer(buffers[eye]);
      textures_[pictures_[eye].empty() ? 0 : eye]->draw();
    }
  }

 private:
  std::array<std::optional<FrameTexture>, 2> textures_;
  std::array<Image<Rgb8>, 2> pictures_;
  bool is_new_ = false;
};

class StereoSurface final : public PictureSurface {
 public:
  StereoSurface() : window_(new StereoWindow), container_(QWidget::createWindowContainer(window_)) {}
  QWidget* widget() override { return container_; }
  QObject* pointed_at() override { return window_; }
  void show(const Frame& frame) override { window_->show_frame(frame); }
  bool uses_opengl() const override { return true; }

 private:
  StereoWindow* window_;  ///< of the container
  QWidget* container_;    ///< of the window that it becomes part of
};

}  // namespace

std::unique_ptr<PictureSurface> make_stereo_surface() {
  QOpenGLContext context;
  context.setFormat(stereo_format());
  if (!context.create() || !context.format().stereo())
    throw Error(ErrorKind::cannot_read_write,
                "--stereo: the graphics driver has no stereo (quad buffers); other output modes need none");
  return std::make_unique<StereoSurface>();
}

}  // namespace wheatstone::viewer
