#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace wheatstone {

/// The file that a model names, as a path in the model's folder or below it: nothing where there is no such plain file,
/// or where it lies elsewhere, be it through "..", an absolute name or a symbolic link.
inline std::optional<std::filesystem::path> file_beside_model(const std::filesystem::path& model, std::string name) {
  namespace fs = std::filesystem;
  for (char& c : name)
    if (c == '\\') c = '/';
  std::error_code error;
  const fs::path folder = fs::canonical(model.parent_path().empty() ? "." : model.parent_path(), error);
  if (error || name.empty() || name.find('\0') != std::string::npos || fs::path(name).is_absolute()) return {};
  const fs::path file = fs::canonical(folder / name, error);
  if (error || !fs::is_regular_file(file, error)) return {};
  const fs::path within = file.lexically_relative(folder);
  if (within.empty() || *within.begin() == "..") return {};
  return file;
}

}  // namespace wheatstone
