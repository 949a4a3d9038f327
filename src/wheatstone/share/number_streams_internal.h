#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/share/page.h"

namespace wheatstone {

/// Numbers in few bytes: seven bits a byte, the lowest first. NumberStream of page/parts.ts reads them.
class NumberStream {
 public:
  void add_whole(std::uint64_t number) {
    for (; number >= 128; number >>= 7) bytes_.push_back(static_cast<std::uint8_t>(number | 128));
    bytes_.push_back(static_cast<std::uint8_t>(number));
  }
  /// Of either sign: small ones of both become small.
  void add_signed(std::int64_t number) {
    add_whole(number < 0 ? 2 * static_cast<std::uint64_t>(-(number + 1)) + 1 : 2 * static_cast<std::uint64_t>(number));
  }

  std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// A part that holds streams, deflated: streams of one kind of number each take fewer bytes than one of all.
PagePart part_of_streams(std::string name, std::span<const NumberStream> streams);

/// The number of steps that a length takes.
inline std::int64_t in_steps(float length_px, int steps_a_px) {
  return std::llround(static_cast<double>(length_px) * steps_a_px);
}

}  // namespace wheatstone
