#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>

#include "wheatstone/files/struct_fields.h"
#include "wheatstone/video/fingerprint_internal.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {
namespace {

constexpr std::uint64_t samples = 64;
constexpr std::uint64_t sample_bytes = 16384;

}  // namespace

void Fingerprint::add(std::string_view bytes) {
  constexpr std::uint64_t prime = 1099511628211u;
  for (const char byte : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * prime;
  // "ab" and "c" are not "a" and "bc".
  hash_ = (hash_ ^ 0x1ffu) * prime;
}

void Fingerprint::add_file(const std::filesystem::path& path) {
  if (const auto pattern = frame_pattern(path)) {
    for (const std::int64_t number : numbers_of(*pattern)) add_file(pattern->file(number));
    return;
  }
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  add(fmt::format("{}", error ? 0 : size));
  if (error) return;
  std::ifstream file(path, std::ios::binary);
  std::array<char, sample_bytes> buffer{};
  const std::uint64_t count = std::min(samples, size / sample_bytes + 1);
  for (std::uint64_t i = 0; i < count; ++i) {
    // Evenly spread, the last one at the end.
    const std::uint64_t last = size > sample_bytes ? size - sample_bytes : 0;
    file.seekg(static_cast<std::streamoff>(count == 1 ? 0 : last * i / (count - 1)));
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    add({buffer.data(), static_cast<std::size_t>(file.gcount())});
    file.clear();
  }
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", hash_); }

std::string fingerprint_of(const FilmWriterOptions& options, const SegmentOptions& segments) {
  Fingerprint print;
  FilmWriterOptions values = options;
  values.side_streams_from.clear();  // its content counts, not its name
  print.add(text_of_fields(values));
  print.add(fmt::format("{}", segments.frames_per_segment));
  print.add(segments.made_by);
  print.add(fmt::format("{}", libav().avcodec_version()));
  if (!options.side_streams_from.empty()) print.add_file(options.side_streams_from);
  for (const std::filesystem::path& source : segments.made_from) print.add_file(source);
  return print.text();
}

}  // namespace wheatstone
