#include "wheatstone/files/output_paths.h"

#include <fmt/format.h>

#include <system_error>

#include "wheatstone/error.h"

namespace wheatstone {

namespace fs = std::filesystem;

fs::path followed(const fs::path& path) {
  constexpr int most_links = 40;  // as Linux has it
  std::error_code error;
  fs::path place = fs::absolute(path);
  for (int links = 0; links < most_links; ++links) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) {
      const fs::path whole = fs::weakly_canonical(place, error);
      return error ? place : whole;
    }
    place = place.parent_path() / target;
  }
  return fs::absolute(path);
}

void check_not_an_input(const std::filesystem::path& output, std::span<const std::filesystem::path> inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code missing;
    if (!std::filesystem::equivalent(output, input, missing)) continue;
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is the same file as the input {}, expected another output",
                                                    output.string(), input.string()));
  }
}

void check_distinct_outputs(std::span<const NamedOutput> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const NamedOutput &one = outputs[j], &other = outputs[i];
      if (one.file.empty() || other.file.empty()) continue;
      std::error_code missing;
      if (followed(one.file) != followed(other.file) && !std::filesystem::equivalent(one.file, other.file, missing))
        continue;
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: {} is the same file as that of {}, expected another name",
                                                      other.option, other.file.string(), one.option));
    }
  }
}

}  // namespace wheatstone
