#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wheatstone {

/// How the ranks of a run reach each other. Every call but `rank` and `count` is collective: all ranks make it.
class Transport {
 public:
  Transport() = default;
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  virtual int rank() const = 0;
  virtual int count() const = 0;
  /// Gives a number to each rank, and takes one from each: both are as long as there are ranks.
  virtual void swap_numbers(std::span<const std::uint64_t> to, std::span<std::uint64_t> from) = 0;
  /// Gives bytes to each rank, and takes bytes from each, whose numbers are known: `from` is of the right sizes.
  virtual void swap_bytes(std::span<const std::vector<std::byte>> to, std::span<std::vector<std::byte>> from) = 0;
  /// Ends all ranks at once, where one of them can no longer take part.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

/// Of the module: begins and ends with the transport that it gives.
using StartTransport = Transport*();
constexpr auto start_transport_name = "wheatstone_start_mpi";

}  // namespace wheatstone
