#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "wheatstone/app/rotoscope.h"

namespace wheatstone {

/// What the next frame depends on as bytes, exactly to the bit: "WSRSTATE", the CRC-32 of all that
/// follows, layout_of<RotoscopeState>(), and the members (files/field_bytes.h). For this version only.
std::string encode_rotoscope_state(const RotoscopeState& state);

/// Reads it back. Checksum, lengths and indices are checked. Throws Error{bad_input} with `name` in front where it is
/// damaged or another version has written it.
RotoscopeState decode_rotoscope_state(std::string_view bytes, std::string_view name);

/// Puts the header that decode_rotoscope_state expects before the members' bytes. For tests that change them.
std::string rotoscope_state_with_checksum(std::string_view members);

/// Writes the file, whole or not at all. Throws Error{cannot_read_write}.
void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state);

/// Throws Error{bad_input}.
RotoscopeState read_rotoscope_state(const std::filesystem::path& path);

/// The state of a film between frames: that of its shot, and that of the shot that dissolves into it.
struct FilmState {
  RotoscopeState shot;
  std::optional<RotoscopeState> outgoing;
};

/// Writes the file, and another one beside it for a shot that fades out. Throws Error{cannot_read_write}.
void write_film_state(const std::filesystem::path& path, const FilmState& state);

/// Throws Error{bad_input}.
FilmState read_film_state(const std::filesystem::path& path);

/// Removes what write_film_state wrote, if it is there.
void remove_film_state(const std::filesystem::path& path);

}  // namespace wheatstone
