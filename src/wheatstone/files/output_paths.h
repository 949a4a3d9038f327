#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace wheatstone {

/// Where a file lies that is written under this name: symbolic links are followed, also one whose target does not exist
/// yet. A path without links and dots; `path` itself, made absolute, where links form a circle.
std::filesystem::path followed(const std::filesystem::path& path);

/// Sees to it that a run does not write over what it reads. Throws Error{wrong_usage} that names the output where it is
/// the same file as one of the inputs, also through symbolic or hard links. Names of files that do not exist, and empty
/// names, are the same as none.
void check_not_an_input(const std::filesystem::path& output, std::span<const std::filesystem::path> inputs);

/// An output and the option that names it.
struct NamedOutput {
  std::string option;
  std::filesystem::path file;  ///< empty: it is not wanted
};

/// Throws Error{wrong_usage} that names both options where two outputs are the same file, under whatever name, also
/// where it does not exist yet.
void check_distinct_outputs(std::span<const NamedOutput> outputs);

}  // namespace wheatstone
