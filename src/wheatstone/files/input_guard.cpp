#include "wheatstone/files/input_guard.h"

#include <fmt/format.h>

#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/files/followed_path.h"

namespace wheatstone {

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
