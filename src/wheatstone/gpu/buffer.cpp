#include "wheatstone/gpu/buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "wheatstone/error.h"

namespace wheatstone {

namespace {

/// Drivers are not asked for what no program can take: they do not all refuse it.
void check_size(std::size_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > static_cast<std::size_t>(most))
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("graphics processor: its programs take {} MB at once at most, and {} MB are needed; --device cpu "
                    "needs no such room",
                    most >> 20, (bytes >> 20) + 1));
}

}  // namespace

GpuBuffer::GpuBuffer(std::size_t bytes) : GpuBuffer(bytes, nullptr) { clear(); }

// Values are given with the storage: a driver was seen to clear a buffer of over 20 kB after they had been written.
GpuBuffer::GpuBuffer(std::span<const std::byte> values)
    : GpuBuffer(values.size(), values.empty() ? nullptr : values.data()) {
  if (values.empty()) clear();
}

GpuBuffer::GpuBuffer(std::size_t bytes, const std::byte* values) : bytes_(std::max<std::size_t>(bytes, 4)) {
  check_size(bytes_);
  glCreateBuffers(1, &name_);
  glNamedBufferStorage(name_, static_cast<GLsizeiptr>(bytes_), values, GL_DYNAMIC_STORAGE_BIT);
  if (glGetError() == GL_OUT_OF_MEMORY) {
    glDeleteBuffers(1, &name_);
    throw Error(ErrorKind::wrong_usage,
                fmt::format("graphics processor: its memory does not hold another {} MB", (bytes_ >> 20) + 1));
  }
}

GpuBuffer::~GpuBuffer() {
  glDeleteTextures(1, &texels_);
  glDeleteBuffers(1, &name_);
}

void GpuBuffer::clear() { glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr); }

void GpuBuffer::clear(std::size_t at, std::size_t bytes) {
  glClearNamedBufferSubData(name_, GL_R32UI, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER,
                            GL_UNSIGNED_INT, nullptr);
}

void GpuBuffer::bind(std::uint32_t binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_); }

void GpuBuffer::bind_uniforms() const {
  constexpr std::size_t always_fits = 16384;
  if (bytes_ <= always_fits) glBindBufferBase(GL_UNIFORM_BUFFER, 0, name_);
}

void GpuBuffer::bind_texels(std::uint32_t unit) const {
  if (texels_ == 0) {
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &texels_);
    glTextureBuffer(texels_, GL_RGBA32UI, name_);
  }
  glBindTextureUnit(unit, texels_);
}

void GpuBuffer::write_bytes(std::span<const std::byte> bytes, std::size_t at) {
  glNamedBufferSubData(name_, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void GpuBuffer::read_bytes(std::span<std::byte> bytes) const {
  glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

}  // namespace wheatstone
