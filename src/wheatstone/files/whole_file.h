#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace wheatstone {

enum class Pipes { refused, accepted };

/// Sees to it that what is opened by this name is a file with an end. Throws Error{bad_input} that says what it is and
/// what was expected (for example "a picture") where there is none, where it is empty, a folder, a device or a socket,
/// or a pipe that is not accepted; Error{cannot_read_write} where it may not be read.
void check_plain_file(const std::filesystem::path& path, std::string_view expected, Pipes pipes = Pipes::refused);

/// Whether there is a folder of that name; false where that cannot be told.
bool is_folder(const std::filesystem::path& path);

/// All bytes of a plain file, or of a pipe of at most 64 MiB, which can be read once. Throws Error{bad_input} where it
/// cannot be read, is anything else or is longer than `most_bytes`.
std::string read_whole_file(const std::filesystem::path& path, std::size_t most_bytes);

/// Writes a file under a temporary name and renames it when it is whole. Throws Error{cannot_read_write}.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);
/// The same of bytes that lie in parts.
void write_whole_file(const std::filesystem::path& path, std::span<const std::string_view> parts);

}  // namespace wheatstone
