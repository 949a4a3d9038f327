#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

namespace wheatstone {

/// Memory of the graphics processor. Made and used within on_gpu().
class GpuBuffer {
 public:
  /// Its bytes are 0. Throws Error{wrong_usage} where the memory does not suffice or no program takes as much.
  explicit GpuBuffer(std::size_t bytes);
  template <class Value>
  explicit GpuBuffer(std::span<const Value> values) : GpuBuffer(std::as_bytes(values)) {
    static_assert(std::is_trivially_copyable_v<Value>);
  }
  /// Its bytes are what they happen to be.
  static GpuBuffer of_any_bytes(std::size_t bytes) { return {bytes, nullptr}; }
  ~GpuBuffer();
  GpuBuffer(GpuBuffer&& other) noexcept
      : name_(std::exchange(other.name_, 0)), texels_(std::exchange(other.texels_, 0)), bytes_(other.bytes_) {}
  GpuBuffer(const GpuBuffer&) = delete;
  GpuBuffer& operator=(const GpuBuffer&) = delete;
  GpuBuffer& operator=(GpuBuffer&&) = delete;

  std::size_t bytes() const { return bytes_; }
  /// Sets all bytes to 0.
  void clear();
  /// Sets some bytes to 0, from that place on. Both are multiples of four.
  void clear(std::size_t at, std::size_t bytes);
  /// Values are copied to the place that many bytes from the beginning, and must fit there.
  template <class Value>
  void write(std::span<const Value> values, std::size_t at = 0) {
    static_assert(std::is_trivially_copyable_v<Value>);
    write_bytes(std::as_bytes(values), at);
  }
  template <class Value>
  void read(std::span<Value> values) const {
    static_assert(std::is_trivially_copyable_v<Value>);
    read_bytes(std::as_writable_bytes(values));
  }
  /// For GpuProgram.
  void bind(std::uint32_t binding) const;
  /// To binding 0 of uniform blocks, where it is small enough for one.
  void bind_uniforms() const;
  /// The same as a usamplerBuffer of four words each: reading these is faster than reading four numbers one by one,
  /// where the processor imitates a graphics processor three times.
  void bind_texels(std::uint32_t unit) const;

 private:
  explicit GpuBuffer(std::span<const std::byte> values);
  GpuBuffer(std::size_t bytes, const std::byte* values);
  void write_bytes(std::span<const std::byte> bytes, std::size_t at);
  void read_bytes(std::span<std::byte> bytes) const;

  std::uint32_t name_ = 0;
  mutable std::uint32_t texels_ = 0;  // made when they are first bound
  std::size_t bytes_ = 0;
};

}  // namespace wheatstone
