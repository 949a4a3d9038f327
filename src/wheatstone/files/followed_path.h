#pragma once

#include <filesystem>

namespace wheatstone {

/// Where a file lies that is written under this name: symbolic links are followed, also one whose target does not exist
/// yet. A path without links and dots; `path` itself, made absolute, where links form a circle.
std::filesystem::path followed(const std::filesystem::path& path);

}  // namespace wheatstone
