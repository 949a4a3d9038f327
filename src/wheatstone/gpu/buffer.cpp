#include "wheatstone/gpu/buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "wheatstone/error.h"

namespace wheatstone {

GpuBuffer::GpuBuffer(std::size_t bytes) : bytes_(std::max<std::size_t>(bytes, 4)) {
  glCreateBuffers(1, &name_);
  glNamedBufferStorage(name_, static_cast<GLsizeiptr>(bytes_), nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (glGetError() == GL_OUT_OF_MEMORY) {
    glDeleteBuffers(1, &name_);
    throw Error(ErrorKind::wrong_usage,
                fmt::format("graphics processor: its memory does not hold another {} MB", (bytes_ >> 20) + 1));
  }
  clear();
}

GpuBuffer::~GpuBuffer() { glDeleteBuffers(1, &name_); }

void GpuBuffer::clear() { glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr); }

void GpuBuffer::bind(std::uint32_t binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_); }

void GpuBuffer::write_bytes(std::span<const std::byte> bytes, std::size_t at) {
  glNamedBufferSubData(name_, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void GpuBuffer::read_bytes(std::span<std::byte> bytes) const {
  glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

}  // namespace wheatstone
