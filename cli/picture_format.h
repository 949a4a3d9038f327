#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace wheatstone::cli {

/// Adds --format: png, jpg, tif or webp.
CLI::Option* add_picture_format(CLI::App& command, std::string& format, const std::string& help);

/// Throws Error{wrong_usage} where an output that is one picture has an ending that no picture has, naming those that
/// there are. `option` is the output's.
void check_picture_ending(const std::string& option, const std::string& output);

}  // namespace wheatstone::cli
