#include "wheatstone/files/input_guard.h"

#include <fmt/format.h>

#include <system_error>

#include "wheatstone/error.h"

namespace wheatstone {

void check_not_an_input(const std::filesystem::path& output, std::span<const std::filesystem::path> inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code missing;
    if (!std::filesystem::equivalent(output, input, missing)) continue;
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is the same file as the input {}, expected another output",
                                                    output.string(), input.string()));
  }
}

}  // namespace wheatstone
