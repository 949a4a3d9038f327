#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "command.h"

namespace wheatstone::cli {

/// Facts as JSON text. File names are bytes, which need not be UTF-8: what is not becomes U+FFFD.
/// `indent` < 0 puts everything on one line.
std::string json_text(const nlohmann::ordered_json& facts, int indent = 2);

/// Prints facts as the one JSON object that --json asks for.
void print_facts(const nlohmann::ordered_json& facts, const Session& session);

/// A message on one line, whatever the names of files in it hold: control characters become spaces.
std::string one_line(std::string message);

}  // namespace wheatstone::cli
