#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "command.h"

namespace wheatstone::cli {

/// The program with all its commands. `session` is filled when a line is parsed and must outlive the program.
std::unique_ptr<CLI::App> make_program(Session& session);

}  // namespace wheatstone::cli
