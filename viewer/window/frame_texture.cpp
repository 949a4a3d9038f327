#include "frame_texture.h"

#include <QOpenGLContext>
#include <QOpenGLFunctions_4_5_Core>
#include <QOpenGLShaderProgram>
#include <QOpenGLVersionFunctionsFactory>

#include "wheatstone/error.h"

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

QOpenGLFunctions_4_5_Core& functions_of(QOpenGLContext& context) {
  auto* const functions = QOpenGLVersionFunctionsFactory::get<QOpenGLFunctions_4_5_Core>(&context);
  if (functions == nullptr) throw Error(ErrorKind::cannot_read_write, "OpenGL 4.5 is not available");
  return *functions;
}

}  // namespace

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

}  // namespace wheatstone::viewer
