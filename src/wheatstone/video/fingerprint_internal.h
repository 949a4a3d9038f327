#pragma once

// A short name for everything that decides a film's bytes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/video/segmented_film.h"

namespace wheatstone {

/// FNV-1a, 64 bits: tells runs apart, keeps no secrets.
class Fingerprint {
 public:
  void add(std::string_view bytes);
  /// A file's size and 64 samples of it; of a pattern, every file of it.
  void add_file(const std::filesystem::path& path);
  std::string text() const;

 private:
  std::uint64_t hash_ = 14695981039346656037u;
};

/// Options, segments and sources together, and the version of the encoders.
std::string fingerprint_of(const FilmWriterOptions& options, const SegmentOptions& segments);

}  // namespace wheatstone
