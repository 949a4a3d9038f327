#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace wheatstone::packaging {

// What a shell offers behind a word of the command line: commands, kinds, options, and the values of an option that
// has a list of them ("auto|always|never"); elsewhere files. Made from the program itself, so that it is never behind.

std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

}  // namespace wheatstone::packaging
