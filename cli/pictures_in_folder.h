#pragma once

#include <filesystem>
#include <vector>

namespace wheatstone::cli {

/// The pictures in a folder, by their endings, in the order of their names.
std::vector<std::filesystem::path> pictures_in_folder(const std::filesystem::path& folder);

}  // namespace wheatstone::cli
