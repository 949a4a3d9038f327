#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace wheatstone::cli {

/// Adds the layout of a quilt with so many pixels, as its name tells it; returns false, and adds nothing, where the
/// name is not that of a quilt.
bool put_quilt(nlohmann::ordered_json& facts, const std::filesystem::path& path, int width, int height);

}  // namespace wheatstone::cli
