#include "opentrack.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace wheatstone::viewer {

std::optional<HeadPose> parse_opentrack(std::span<const std::byte> packet) {
  std::array<double, 6> numbers{};
  if (packet.size() != sizeof numbers) return {};
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; byte < sizeof bits; ++byte)
      bits |= std::to_integer<std::uint64_t>(packet[n * sizeof bits + byte]) << (8 * byte);
    numbers[n] = std::bit_cast<double>(bits);
  }
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) return {};
  return HeadPose{numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
}

}  // namespace wheatstone::viewer
