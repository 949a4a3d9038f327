#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// Saves a painting as FlatBuffers (schema: docs/painting.fbs), under a temporary name first.
/// Throws Error{cannot_read_write}.
void write_painting(const std::filesystem::path& path, const Painting& painting);

/// Reads a painting back, equal to what was written, or of an earlier version. Everything is checked before it is
/// used: structure, version, checksum, index ranges, and that all numbers are finite. Throws Error{bad_input}.
Painting read_painting(const std::filesystem::path& path);

/// The same in memory; `name` stands for the file in messages.
std::string encode_painting(const Painting& painting);
Painting decode_painting(std::string_view bytes, std::string_view name);

}  // namespace wheatstone
