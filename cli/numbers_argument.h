#pragma once

#include <string>
#include <vector>

namespace wheatstone::cli {

/// "640x360" as two numbers, "1,2,3" as three: exactly `count`, with `between` between them. Throws Error{wrong_usage}
/// naming the option.
std::vector<float> parse_numbers(const std::string& option, const std::string& text, char between, std::size_t count);

}  // namespace wheatstone::cli
