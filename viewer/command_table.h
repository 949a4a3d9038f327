#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viewer.h"

namespace wheatstone::viewer {

using Words = std::vector<std::string>;

/// The words of a line: separated by white space, but for what stands in double quotes. Empty lines, and those that
/// begin with #, have none. Throws Error{wrong_usage} where a quote is not closed.
Words words_of(std::string_view line);

// What a word says. They throw Error{wrong_usage}, as "'a' is no number".

double number_of(const std::string& word);
double number_of(const std::string& word, double least, double most);
bool switch_of(const std::string& word);  ///< "on" or "off"
/// The place of a word among names; `what` is what they name. Throws Error{wrong_usage}.
std::size_t place_among(std::span<const std::string_view> names, const std::string& word, std::string_view what);

/// Something that a command's argument can be.
struct Choice {
  std::string words;  ///< as a script has it
  std::string text;   ///< for people
};

/// What the number that a command takes may be, for a slider. None where `step` is 0.
struct SteppedRange {
  double least = 0, most = 0, step = 0;
};

/// How menus, panels and the toolbar show a command; what a row leaves out is as usual.
struct Entry {
  std::vector<Choice> (*choices)(const Viewer&) = nullptr;  ///< a submenu; none: those that `arguments` lists
  std::string (*now)(const Viewer&) = nullptr;  ///< the argument that stands; of a command without, "on" or "off"
  SteppedRange range = {};
  bool (*applies)(const Viewer&) = nullptr;  ///< grey where it does not; none: as its menu
  std::string_view icon = {};                ///< in the toolbar; empty: it is not there
  bool begins_group = false;                 ///< a line is drawn above it
  bool is_for_scripts = false;               ///< another entry does the same for people
  bool is_text = false;                      ///< a panel has a line to type it in
};

/// One line of the table of commands, from which the menus, the keys, the help and scripts are made.
struct Command {
  std::string_view name;       ///< "zero-parallax-at"
  std::string_view arguments;  ///< as the help shows them, "X Y"; empty: none
  std::string_view menu;       ///< in which it stands
  std::string_view text;       ///< what it does, as a menu says it
  std::string_view keys;       ///< as Qt writes them, "F, F11"; empty: none
  /// Does it. Throws Error{wrong_usage} where an argument does not fit, and what it does may throw.
  void (*run)(Viewer&, const Words&);
  Entry entry = {};
};

std::span<const Command> command_table();

/// A command's text without what explains it further.
std::string title_of(const Command& command);

/// Whether a command has any effect on what is open.
bool applies(const Viewer& viewer, const Command& command);

/// What a command's argument can be: as its row says, or the words of "back|front". Empty where it is anything else.
std::vector<Choice> choices_of(const Viewer& viewer, const Command& command);

/// Whether a command turns something on and off, so that a menu shows it with a tick.
bool is_toggle(const Command& command);

/// Throws Error{wrong_usage} that names the command.
const Command& find_command(std::string_view name);

/// Does a command with its arguments. What it changes of the state can be undone. Throws as the command does, and
/// Error{wrong_usage} where there are too few or too many arguments.
void run_command(Viewer& viewer, const Command& command, const Words& arguments);

/// Does what a line says: a command's name and its arguments. Empty lines, and those that begin with #, say nothing.
void run_line(Viewer& viewer, std::string_view line);

/// What a command changes of a session, so that it can be undone: to be made before the command, and `keep` called
/// behind it. From where one looks (zoom, pan, head, orbit, the side of layers, the photograph) is not undone.
class Change {
 public:
  explicit Change(const Session& session) : before_(session.state), target_before_(session.zero_parallax_target_px) {}
  /// Keeps the state before for `undo` where something that can be undone has changed.
  void keep(Session& session) const;

 private:
  ViewState before_;
  std::optional<float> target_before_;
};

void undo(Viewer& viewer);
void redo(Viewer& viewer);

// The parts of the table, in its order, one a file.
std::span<const Command> file_commands();
std::span<const Command> looking_commands();
std::span<const Command> retouch_commands();
std::span<const Command> depth_commands();
std::span<const Command> input_commands();
std::span<const Command> painting_commands();
std::span<const Command> film_commands();
std::span<const Command> particle_commands();
std::span<const Command> quantity_commands();
std::span<const Command> camera_commands();
std::span<const Command> panel_commands();

inline ViewState& state_of(Viewer& viewer) { return viewer.session().state; }

/// "fitted-strokes" as "Fitted strokes".
std::string readable(std::string_view name);

// What rows say of themselves.
inline std::string on_or_off(bool is_on) { return is_on ? "on" : "off"; }
bool shows_something(const Viewer& viewer);
bool shows_painting(const Viewer& viewer);
bool shows_particles(const Viewer& viewer);
bool shows_scene(const Viewer& viewer);  ///< particles, a model or slices

/// Throws Error{wrong_usage} before the first frame.
const Frame& frame_of(const Viewer& viewer);

}  // namespace wheatstone::viewer
