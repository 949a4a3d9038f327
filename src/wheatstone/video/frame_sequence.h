#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wheatstone {

/// A file name with a place for a number, as printf and ffmpeg write it: "frame_%04d.png" is frame_0001.png and so on,
/// "%%" is a percent sign. The folder is taken literally.
struct FramePattern {
  std::filesystem::path folder;
  std::string before;  ///< the number
  std::string after;
  int least_digits = 1;

  std::filesystem::path file(std::int64_t number) const;
  /// The number in a file name of this pattern.
  std::optional<std::int64_t> number_of(const std::string& file_name) const;
};

/// The pattern that a path is; nothing where its file name holds no percent sign, or where a file of just that name
/// exists. Throws Error{wrong_usage} where it is malformed or holds more than one number.
std::optional<FramePattern> frame_pattern(const std::filesystem::path& path);

/// The numbers of the files that exist, ascending.
std::vector<std::int64_t> numbers_of(const FramePattern& pattern);

/// The same of at least so many files, without a hole between the first and the last. Throws Error{bad_input} naming
/// the first file that is missing.
std::vector<std::int64_t> numbers_without_hole(const FramePattern& pattern, std::size_t least = 1);

}  // namespace wheatstone
