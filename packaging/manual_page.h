#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace wheatstone::packaging {

/// A command's manual page, as groff with the man macros, from what its --help shows. `date` is that of the page, as
/// "2026-11-22"; `version` the program's.
std::string manual_page(const CLI::App& command, const std::string& date, const std::string& version);

/// The words by which a command is called: "wheatstone synth film". Its page is named with hyphens between them.
std::string words_of(const CLI::App& command);

}  // namespace wheatstone::packaging
