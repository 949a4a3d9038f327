#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "wheatstone/error.h"
#include "wheatstone/particles/cloud_source.h"

namespace wheatstone::fuzz {

/// The input as a file in memory, since that is what readers read.
inline std::filesystem::path as_file(const std::uint8_t* data, std::size_t size, const char* ending) {
  static const std::filesystem::path path =
      std::filesystem::path("/dev/shm") / ("wheatstone_fuzz_" + std::to_string(::getpid()) + ending);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

/// Reads the input as particles to its end. Refusing it is right; anything else than an Error is not.
inline int read_particles(const std::uint8_t* data, std::size_t size, const char* magic,
                          const CloudChoice& choice = {}) {
  // Of the formats that are told by their first bytes only the one in question.
  const std::string text = std::string(magic) + std::string(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path path = as_file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), ".bin");
  try {
    const CloudSource source = open_cloud(path, choice);
    std::uint64_t count = 0;
    while (count < 100'000) {
      const Cloud cloud = source.next(1000);
      if (cloud.size() == 0) break;
      count += cloud.size();
    }
  } catch (const Error&) {
  }
  std::filesystem::remove(path);
  return 0;
}

}  // namespace wheatstone::fuzz
