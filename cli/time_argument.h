#pragma once

#include <optional>
#include <string>

namespace wheatstone::cli {

/// A moment of a film as ffmpeg takes it: seconds, or [HH:]MM:SS[.m]; nothing where the text is empty. Throws
/// Error{wrong_usage} that names the option.
std::optional<double> time_option(const std::string& option, const std::string& text);

}  // namespace wheatstone::cli
