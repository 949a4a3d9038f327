#pragma once

#include <filesystem>

namespace wheatstone::golden {

/// Where the plans and pictures are that the tests compare with.
std::filesystem::path kept_folder();

/// Where a test that fails leaves its picture and the difference.
std::filesystem::path difference_folder();

}  // namespace wheatstone::golden
