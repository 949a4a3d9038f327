#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace wheatstone::cli {

/// What a film says of itself, for `info`.
nlohmann::ordered_json facts_of_film(const std::filesystem::path& path);

}  // namespace wheatstone::cli
