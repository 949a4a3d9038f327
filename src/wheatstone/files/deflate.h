#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// Some of the bytes that are deflated: borrowed, or made in `room`, which is empty.
using PartOfBytes = std::function<std::span<const std::uint8_t>(std::size_t part, std::vector<std::uint8_t>& room)>;

/// A zlib stream (RFC 1950) of bytes that come in `parts`, each of which is asked for once, from any thread. They are
/// deflated by themselves and at once: the stream depends on how they are divided, not on threads. Parts of half a MiB
/// and more cost nothing in size. Made for speed; zlib's best effort takes 50 times as long for a fifth less.
std::string zlib_stream(std::size_t parts, const PartOfBytes& part_of);

/// The same of bytes in memory.
std::string zlib_stream(std::span<const std::uint8_t> bytes);

/// Bytes in fewer bytes, as zlib reads them, quickly.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes);
/// The same by zlib itself, for files that travel: level 9 takes 50 times as long for a fifth less.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, int level);

/// The checksum of gzip and PNG (RFC 1952, sec. 8).
std::uint32_t crc32_of(std::span<const std::uint8_t> bytes);
std::uint32_t crc32_of(std::string_view bytes);

/// The bytes again, which are `size` many; nothing where the deflated ones are not exactly those of so many. Memory is
/// taken only for what they can hold.
std::optional<std::vector<std::uint8_t>> inflated(std::span<const std::uint8_t> bytes, std::size_t size);

}  // namespace wheatstone
