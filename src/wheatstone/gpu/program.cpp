#include "wheatstone/gpu/program.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// Lines that define what tells a variant from others.
std::string lines_of(std::initializer_list<GpuDefine> defines) {
  std::string lines;
  for (const GpuDefine& define : defines) lines += fmt::format("#define {} {}\n", define.name, define.value);
  return lines;
}

/// The text of a variant, in which lines keep their numbers.
std::string text_of(const GpuSource& source, std::initializer_list<GpuDefine> defines) {
  std::string text(source.text);
  if (defines.size() > 0) text.insert(text.find('\n') + 1, lines_of(defines) + "#line 2\n");
  return text;
}

/// The driver's first line about what it refused.
[[noreturn]] void refuse(const GpuSource& source, std::string log) {
  log.resize(std::min(log.find_first_of("\n\0", 0, 2), log.size()));
  throw Error(ErrorKind::wrong_usage, fmt::format("graphics processor: its driver refuses {}: {}", source.name, log));
}

}  // namespace

GpuProgram::GpuProgram(const GpuSource& source, std::initializer_list<GpuDefine> defines) {
  // The program is separable: it has one stage, which is compiled and linked at once.
  const std::string text = text_of(source, defines);
  const char* const texts = text.c_str();
  name_ = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &texts);
  GLint linked = GL_FALSE;
  if (name_ != 0) glGetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(2048, '\0');
  if (name_ != 0) glGetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteProgram(name_);
  refuse(source, log);
}

GpuProgram::~GpuProgram() { glDeleteProgram(name_); }

void GpuProgram::run(std::initializer_list<std::uint32_t> groups, std::initializer_list<const GpuBuffer*> buffers,
                     std::initializer_list<const GpuBuffer*> texels) const {
  std::array<std::uint32_t, 3> count{1, 1, 1};
  std::ranges::copy(groups, count.begin());
  std::uint32_t binding = 0;
  if (buffers.size() > 0) (*buffers.begin())->bind_uniforms();
  for (const GpuBuffer* const buffer : buffers) buffer->bind(binding++);
  std::uint32_t unit = 0;
  for (const GpuBuffer* const buffer : texels) buffer->bind_texels(unit++);
  glUseProgram(name_);
  glDispatchCompute(count[0], count[1], count[2]);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

const GpuProgram& kept_program(const GpuSource& source, std::initializer_list<GpuDefine> defines) {
  // Never destroyed: at the end of the process there is no context in which it could be. Callers take turns (on_gpu).
  static auto& programs = *new std::map<std::pair<std::string_view, std::string>, GpuProgram>();
  const std::pair<std::string_view, std::string> key(source.text, lines_of(defines));
  const auto found = programs.find(key);
  return found != programs.end() ? found->second : programs.emplace(key, GpuProgram(source, defines)).first->second;
}

}  // namespace wheatstone
