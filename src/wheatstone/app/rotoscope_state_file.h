#pragma once

#include <filesystem>

#include "wheatstone/app/rotoscope.h"

namespace wheatstone {

/// Saves what the next frame depends on, whole or not at all, for this machine and version only: exactly, to the bit.
/// Throws Error{cannot_read_write}.
void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state);

/// Reads it back. All lengths and the checksum are checked. Throws Error{bad_input}.
RotoscopeState read_rotoscope_state(const std::filesystem::path& path);

}  // namespace wheatstone
