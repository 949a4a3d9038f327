#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/app/rotoscope.h"

namespace wheatstone {

/// What the next frame depends on as bytes (FlatBuffers, docs/rotoscope-state.fbs), for this version only: exactly, to
/// the bit. Throws Error{cannot_read_write} where it is more than 2 GB.
std::string encode_rotoscope_state(const RotoscopeState& state);

/// Reads it back. Checksum, lengths and indices are checked. Throws Error{bad_input} with `name` in front.
RotoscopeState decode_rotoscope_state(std::string_view bytes, std::string_view name);

/// What decode_rotoscope_state takes: the content with its head. For tests that change the content.
std::string rotoscope_state_with_checksum(std::string_view content);

/// Writes the file, whole or not at all. Throws Error{cannot_read_write}.
void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state);

/// Throws Error{bad_input}.
RotoscopeState read_rotoscope_state(const std::filesystem::path& path);

}  // namespace wheatstone
