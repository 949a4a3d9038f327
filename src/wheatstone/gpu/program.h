#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "wheatstone/gpu/buffer.h"

namespace wheatstone {

/// The source of a compute program, as the build embeds it. It begins with a line "#version".
struct GpuSource {
  std::string_view name;  ///< of its file
  std::string_view text;
};

/// A macro that is defined for a variant of a source.
struct GpuDefine {
  std::string_view name;
  int value;
};

/// A compute program on the graphics processor. Made and used within on_gpu().
class GpuProgram {
 public:
  /// Throws Error{wrong_usage} with the driver's first line where it refuses the source.
  explicit GpuProgram(const GpuSource& source, std::initializer_list<GpuDefine> defines = {});
  ~GpuProgram();
  GpuProgram(GpuProgram&& other) noexcept : name_(other.name_) { other.name_ = 0; }
  GpuProgram(const GpuProgram&) = delete;
  GpuProgram& operator=(const GpuProgram&) = delete;
  GpuProgram& operator=(GpuProgram&&) = delete;

  /// Runs groups × as many invocations as a group of the source has, in x, y and z. Buffer i is bound to binding i, and
  /// number i of the texels to the sampler there. The first buffer, which tells of the work, is bound to binding 0 of
  /// uniform blocks, too: a driver that imitates a graphics processor reads these four times as fast. What runs next
  /// sees what this wrote.
  void run(std::initializer_list<std::uint32_t> groups, std::initializer_list<const GpuBuffer*> buffers,
           std::initializer_list<const GpuBuffer*> texels = {}) const;

 private:
  std::uint32_t name_ = 0;
};

/// The program of a variant of a source, which is compiled when it is first asked for, and kept to the end of the
/// process. Within on_gpu().
const GpuProgram& kept_program(const GpuSource& source, std::initializer_list<GpuDefine> defines = {});

/// Groups of `size` that cover `count`.
constexpr std::uint32_t groups_of(std::size_t count, std::size_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

/// The same in rows that no driver finds too long: how many a row has, and rows.
constexpr std::array<std::uint32_t, 2> rows_of_groups(std::size_t count, std::size_t size) {
  constexpr std::uint32_t longest = 32768;
  const std::uint32_t groups = groups_of(count, size);
  return {std::min(groups, longest), (groups + longest - 1) / longest};
}

}  // namespace wheatstone
