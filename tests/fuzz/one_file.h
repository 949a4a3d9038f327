#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "wheatstone/error.h"

namespace wheatstone::fuzz {

/// The input as a file in memory, since that is what readers read.
inline std::filesystem::path as_file(const std::uint8_t* data, std::size_t size, const char* ending) {
  const std::filesystem::path path =
      std::filesystem::path("/dev/shm") / ("wheatstone_fuzz_" + std::to_string(::getpid()) + ending);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

}  // namespace wheatstone::fuzz
