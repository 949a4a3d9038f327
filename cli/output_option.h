#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace wheatstone::cli {

/// Adds -o,--output with its default. An empty name is wrong usage.
CLI::Option* add_output_option(CLI::App& command, std::string& output, const std::string& description);

/// Refuses an empty name, for an option that names what is written.
CLI::Validator not_empty();

}  // namespace wheatstone::cli
