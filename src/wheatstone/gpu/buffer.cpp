#include "wheatstone/gpu/buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "clear_words_source.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/program.h"

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

void GpuBuffer::clear() { clear(0, bytes_); }

// By a program: a driver was seen to clear a buffer at 1 GB a second (glClearNamedBufferData), and to lose what was
// written into one of over 64 kB afterwards.
void GpuBuffer::clear(std::size_t at, std::size_t bytes) {
  const std::size_t words = bytes / sizeof(std::uint32_t);
  const std::array work{static_cast<std::uint32_t>(at / sizeof(std::uint32_t)), static_cast<std::uint32_t>(words)};
  const GpuBuffer of_work(std::span<const std::uint32_t>{work});
  const auto [columns, rows] = rows_of_groups(words, 64);
  kept_program(clear_words_source).run({columns, rows}, {&of_work, this});
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

namespace {

/// Memory of the processor into which the graphics processor copies. Kept to the end of the process, as programs are.
struct Landing {
  static constexpr std::size_t bytes = std::size_t{1} << 24;
  std::uint32_t name = 0;
  const void* mapped = nullptr;

  Landing() {
    constexpr GLbitfield mapping = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, bytes, nullptr, mapping | GL_CLIENT_STORAGE_BIT);
    mapped = glMapNamedBufferRange(name, 0, bytes, mapping);
    if (mapped == nullptr)
      throw Error(ErrorKind::wrong_usage, "graphics processor: its driver does not share memory with the processor");
  }
};

}  // namespace

// Through memory that both reach: several times as fast as glGetNamedBufferSubData.
void GpuBuffer::read_bytes(std::span<std::byte> bytes) const {
  static const Landing landing;
  for (std::size_t at = 0; at < bytes.size(); at += Landing::bytes) {
    const std::span<std::byte> some = bytes.subspan(at, std::min(Landing::bytes, bytes.size() - at));
    glCopyNamedBufferSubData(name_, landing.name, static_cast<GLintptr>(at), 0, static_cast<GLsizeiptr>(some.size()));
    glFinish();
    std::memcpy(some.data(), landing.mapped, some.size());
  }
}

}  // namespace wheatstone
