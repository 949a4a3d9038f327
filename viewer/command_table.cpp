#include "command_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "command_groups_internal.h"
#include "undo.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

std::vector<Command> all_commands() {
  std::vector<Command> all;
  for (const std::span<const Command> group :
       {file_commands(), looking_commands(), depth_commands(), input_commands(), painting_commands(), film_commands(),
        particle_commands(), quantity_commands(), camera_commands(), panel_commands()})
    all.insert(all.end(), group.begin(), group.end());
  std::ranges::stable_partition(all, [](const Command& command) { return command.menu != "Help"; });
  return all;
}

/// How many words a command takes: "X Y" two, "FILE [RIGHT]" one or two.
struct WordCount {
  std::size_t least = 0, most = 0;
};

WordCount words_wanted(const Command& command) {
  WordCount count;
  for (const std::string& word : words_of(command.arguments)) {
    ++count.most;
    if (!word.starts_with('[')) ++count.least;
  }
  return count;
}

}  // namespace

std::span<const Command> command_table() {
  static const std::vector<Command> table = all_commands();
  return table;
}

const Frame& frame_of(const Viewer& viewer) {
  if (viewer.frame() == nullptr) throw Error(ErrorKind::wrong_usage, "nothing has been drawn yet");
  return *viewer.frame();
}

const Command& find_command(std::string_view name) {
  const auto found = std::ranges::find(command_table(), name, &Command::name);
  if (found != command_table().end()) return *found;
  throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no command of the viewer; see --commands", name));
}

void run_command(Viewer& viewer, const Command& command, const Words& arguments) {
  const WordCount wanted = words_wanted(command);
  if (arguments.size() < wanted.least || arguments.size() > wanted.most)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: has {} arguments, expected {}", command.name, arguments.size(),
                                                    command.arguments.empty() ? "none" : command.arguments));
  Session& session = viewer.session();
  const Change change(session);
  // A gaze changes all the time.
  const bool is_kept = command.name != "undo" && command.name != "redo" && command.name != "gaze";
  try {
    command.run(viewer, arguments);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", command.name, error.what()));
  }
  if (is_kept) change.keep(session);
}

void run_line(Viewer& viewer, std::string_view line) {
  const Words words = words_of(line);
  if (!words.empty()) run_command(viewer, find_command(words.front()), {words.begin() + 1, words.end()});
}

}  // namespace wheatstone::viewer
