#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace wheatstone {

/// All bytes of a plain file, or of a pipe of at most 64 MiB, which can be read once. Throws Error{bad_input} where it
/// cannot be read, is anything else or is longer than `most_bytes`.
std::string read_whole_file(const std::filesystem::path& path, std::size_t most_bytes);

/// Writes a file under a temporary name and renames it when it is whole. Throws Error{cannot_read_write}.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace wheatstone
