#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wheatstone {

/// Bytes in fewer bytes, as zlib reads them, quickly.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes);
/// The same by zlib itself, for files that travel: level 9 takes 50 times as long for a fifth less.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, int level);

/// The bytes again, which are `size` many; nothing where the deflated ones are not exactly those of so many. Memory is
/// taken only for what they can hold.
std::optional<std::vector<std::uint8_t>> inflated(std::span<const std::uint8_t> bytes, std::size_t size);

}  // namespace wheatstone
