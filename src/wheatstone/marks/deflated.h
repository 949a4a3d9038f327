#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wheatstone {

/// Bytes in fewer bytes (zlib). Higher levels than this one, up to 9, take twice the time for a tenth of the size.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, int level = 4);

/// The bytes again, which are `size` many; nothing where the deflated ones are not exactly those of so many. Memory is
/// taken only for what they can hold.
std::optional<std::vector<std::uint8_t>> inflated(std::span<const std::uint8_t> bytes, std::size_t size);

}  // namespace wheatstone
