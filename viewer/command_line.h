#pragma once

#include <string>

#include "session.h"

namespace wheatstone::viewer {

/// The line for a shell that makes what a session shows: `wheatstone paint …`, `pack …` or `render …`; empty where
/// nothing is open.
std::string command_line_of(const Session& session);

}  // namespace wheatstone::viewer
