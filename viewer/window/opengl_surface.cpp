#include "opengl_surface.h"

#include <QOpenGLFunctions_4_5_Core>
#include <QOpenGLShaderProgram>
#include <QOpenGLVersionFunctionsFactory>
#include <QOpenGLWidget>

namespace wheatstone::viewer {
namespace {

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

/// One texture over the whole widget.
class OpenglSurface final : public QOpenGLWidget, public PictureSurface {
 public:
  OpenglSurface() { setFormat(opengl_format()); }
  ~OpenglSurface() override {
    if (functions_ == nullptr) return;
    makeCurrent();
    functions_->glDeleteTextures(1, &texture_);
    functions_->glDeleteVertexArrays(1, &nothing_);
    program_.reset();
    doneCurrent();
  }
  QWidget* widget() override { return this; }
  bool uses_opengl() const override { return functions_ != nullptr; }

  void show(const Frame& frame) override {
    picture_ = frame.picture;
    is_new_ = true;
    update();
  }

 protected:
  void initializeGL() override {
    functions_ = QOpenGLVersionFunctionsFactory::get<QOpenGLFunctions_4_5_Core>(context());
    if (functions_ == nullptr) return;
    program_ = std::make_unique<QOpenGLShaderProgram>();
    program_->addShaderFromSourceCode(QOpenGLShader::Vertex, vertex_shader);
    program_->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment_shader);
    program_->link();
    functions_->glCreateVertexArrays(1, &nothing_);
    functions_->glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    is_new_ = !picture_.empty();
    size_ = {};
  }

  void paintGL() override {
    if (functions_ == nullptr) return;
    if (is_new_) upload();
    functions_->glClearColor(0, 0, 0, 1);
    functions_->glClear(GL_COLOR_BUFFER_BIT);
    if (size_.isEmpty()) return;
    program_->bind();
    functions_->glBindVertexArray(nothing_);
    functions_->glBindTextureUnit(0, texture_);
    functions_->glDrawArrays(GL_TRIANGLES, 0, 3);
    program_->release();
  }

 private:
  void upload() {
    is_new_ = false;
    const QSize size(picture_.width(), picture_.height());
    if (size != size_) {
      functions_->glDeleteTextures(1, &texture_);
      functions_->glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
      functions_->glTextureStorage2D(texture_, 1, GL_RGB8, size.width(), size.height());
      size_ = size;
    }
    functions_->glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    functions_->glTextureSubImage2D(texture_, 0, 0, 0, size.width(), size.height(), GL_RGB, GL_UNSIGNED_BYTE,
                                    picture_.pixels().data());
  }

  QOpenGLFunctions_4_5_Core* functions_ = nullptr;
  std::unique_ptr<QOpenGLShaderProgram> program_;
  GLuint texture_ = 0, nothing_ = 0;
  QSize size_;
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
