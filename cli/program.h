#pragma once

#include <memory>

#include "command.h"

namespace wheatstone::cli {

/// What the command line says beside the session.
struct SharedOptions {
  Session session;
};

/// The program with all its commands. `options` is filled when a line is parsed and must outlive the program.
std::unique_ptr<CLI::App> make_program(SharedOptions& options);

}  // namespace wheatstone::cli
