#include "picture_surface.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLFunctions_4_5_Core>
#include <QOpenGLShaderProgram>
#include <QOpenGLVersionFunctionsFactory>
#include <QOpenGLWidget>
#include <QOpenGLWindow>
#include <QPainter>
#include <QScreen>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone::viewer {

QImage qimage_of(const Image<Rgb8>& picture) {
  return QImage(reinterpret_cast<const uchar*>(picture.pixels().data()), picture.width(), picture.height(),
                qsizetype{3} * picture.width(), QImage::Format_RGB888)
      .copy();
}

namespace {

class PaintedSurface final : public QWidget, public PictureSurface {
 public:
  PaintedSurface() { setAttribute(Qt::WA_OpaquePaintEvent); }
  QWidget* widget() override { return this; }
  void show(const Frame& frame) override {
    image_ = qimage_of(frame.picture);
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

constexpr auto vertex_shader = R"(#version 450 core
void main() { gl_Position = vec4(ivec2(gl_VertexID & 1, gl_VertexID >> 1) * 4 - 1, 0, 1); }
)";
// A frame's first row is the uppermost, a window's pixel 0 the lowest.
constexpr auto fragment_shader = R"(#version 450 core
uniform sampler2D frame;
out vec4 colour;
void main() {
  ivec2 size = textureSize(frame, 0);
  ivec2 at = ivec2(gl_FragCoord.x, size.y - 1 - int(gl_FragCoord.y));
  colour = all(lessThan(at, size)) && at.y >= 0 ? vec4(texelFetch(frame, at, 0).rgb, 1) : vec4(0, 0, 0, 1);
}
)";

QOpenGLFunctions_4_5_Core& functions_of(QOpenGLContext& context) {
  auto* const functions = QOpenGLVersionFunctionsFactory::get<QOpenGLFunctions_4_5_Core>(&context);
  if (functions == nullptr) throw Error(ErrorKind::cannot_read_write, "OpenGL 4.5 is not available");
  return *functions;
}

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

FrameTexture::FrameTexture(QOpenGLContext& context)
    : functions_(functions_of(context)), program_(std::make_unique<QOpenGLShaderProgram>()) {
  program_->addShaderFromSourceCode(QOpenGLShader::Vertex, vertex_shader);
  program_->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment_shader);
  program_->link();
  functions_.glCreateVertexArrays(1, &nothing_);
  functions_.glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
}

FrameTexture::~FrameTexture() {
  functions_.glDeleteTextures(1, &texture_);
  functions_.glDeleteVertexArrays(1, &nothing_);
}

void FrameTexture::upload(ImageView<const Rgb8> picture) {
  const QSize size(picture.width(), picture.height());
  if (size != size_) {
    functions_.glDeleteTextures(1, &texture_);
    functions_.glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    functions_.glTextureStorage2D(texture_, 1, GL_RGB8, size.width(), size.height());
    size_ = size;
  }
  functions_.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  functions_.glTextureSubImage2D(texture_, 0, 0, 0, size.width(), size.height(), GL_RGB, GL_UNSIGNED_BYTE,
                                 picture.row(0).data());
}

void FrameTexture::draw() {
  functions_.glClearColor(0, 0, 0, 1);
  functions_.glClear(GL_COLOR_BUFFER_BIT);
  if (size_.isEmpty()) return;
  program_->bind();
  functions_.glBindVertexArray(nothing_);
  functions_.glBindTextureUnit(0, texture_);
  functions_.glDrawArrays(GL_TRIANGLES, 0, 3);
  program_->release();
}

QSurfaceFormat opengl_format() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CoreProfile);
  return format;
}

std::unique_ptr<PictureSurface> make_opengl_surface() { return std::make_unique<OpenglSurface>(); }

std::unique_ptr<PictureSurface> make_stereo_surface() {
  QOpenGLContext context;
  context.setFormat(stereo_format());
  if (!context.create() || !context.format().stereo())
    throw Error(ErrorKind::cannot_read_write,
                "--stereo: the graphics driver has no stereo (quad buffers); other output modes need none");
  return std::make_unique<StereoSurface>();
}

}  // namespace wheatstone::viewer
