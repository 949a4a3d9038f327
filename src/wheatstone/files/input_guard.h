#pragma once

#include <filesystem>
#include <span>

namespace wheatstone {

/// Sees to it that a run does not write over what it reads. Throws Error{wrong_usage} that names the output where it is
/// the same file as one of the inputs, also through symbolic or hard links. Names of files that do not exist, and empty
/// names, are the same as none.
void check_not_an_input(const std::filesystem::path& output, std::span<const std::filesystem::path> inputs);

}  // namespace wheatstone
