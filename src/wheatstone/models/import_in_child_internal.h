#pragma once

#include <filesystem>
#include <string>

#include "wheatstone/models/raw_model_internal.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// What a child process may take. Beyond it, the file is refused.
struct ImportLimits {
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< more than this process has
  int seconds = 60;                                 ///< of processor time, and three times as long in all
};

/// Limits that suit a file of so many bytes, on this computer.
ImportLimits import_limits(std::uint64_t file_bytes);

/// Reads a model in a child process, so that what a damaged file does to the importer is done to nothing else. Throws
/// Error{bad_input} that names the file where it cannot be read within the limits; what `progress` throws ends it.
RawModel import_in_child(const std::filesystem::path& file, const std::string& format, const ImportLimits& limits,
                         const Progress& progress);

}  // namespace wheatstone
