#pragma once

#include <span>
#include <string_view>

#include "command_words.h"
#include "viewer.h"

namespace wheatstone::viewer {

/// One line of the table of commands, from which the menus, the keys, the help and scripts are made.
struct Command {
  std::string_view name;       ///< "zero-parallax-at"
  std::string_view arguments;  ///< as the help shows them, "X Y"; empty: none
  std::string_view menu;       ///< in which it stands
  std::string_view text;       ///< what it does, as a menu says it
  std::string_view keys;       ///< as Qt writes them, "F, F11"; empty: none
  /// Does it. Throws Error{wrong_usage} where an argument does not fit, and what it does may throw.
  void (*run)(Viewer&, const Words&);
};

std::span<const Command> command_table();

/// Throws Error{wrong_usage} that names the command.
const Command& find_command(std::string_view name);

/// Does a command with its arguments. What it changes of the state can be undone. Throws as the command does, and
/// Error{wrong_usage} where there are too few or too many arguments.
void run_command(Viewer& viewer, const Command& command, const Words& arguments);

/// Does what a line says: a command's name and its arguments. Empty lines, and those that begin with #, say nothing.
void run_line(Viewer& viewer, std::string_view line);

}  // namespace wheatstone::viewer
