#pragma once

#include <filesystem>
#include <string_view>

namespace wheatstone {

enum class Pipes { refused, accepted };

/// Sees to it that what is opened by this name is a file with an end. Throws Error{bad_input} that says what it is and
/// what was expected (for example "a picture") where there is none, where it is empty, a folder, a device or a socket,
/// or a pipe that is not accepted; Error{cannot_read_write} where it may not be read.
void check_plain_file(const std::filesystem::path& path, std::string_view expected, Pipes pipes = Pipes::refused);

}  // namespace wheatstone
