#include "command_table.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

std::vector<Command> all_commands() {
  std::vector<Command> all;
  for (const std::span<const Command> group :
       {file_commands(), looking_commands(), depth_commands(), input_commands(), painting_commands(), film_commands(),
        camera_commands(), particle_commands(), quantity_commands(), panel_commands(), retouch_commands()})
    all.insert(all.end(), group.begin(), group.end());
  std::stable_partition(all.begin(), all.end(), [](const Command& command) { return command.menu != "Help"; });
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

/// What can be undone of a state: not where one looks from.
ViewState parameters_of(ViewState state) {
  const ViewState as_new;
  state.framed = as_new.framed;
  state.head = as_new.head;
  state.orbit = as_new.orbit;
  state.share = as_new.share;
  state.step = as_new.step;
  state.comparison = as_new.comparison;
  state.layers_apart_deg = as_new.layers_apart_deg;
  state.depth_around = as_new.depth_around;
  // A stroke of the hand is undone as a whole.
  while (!state.touches.empty() && state.touches.back().goes_on) state.touches.pop_back();
  return state;
}

void go_back(Viewer& viewer, std::vector<ViewState>& from, std::vector<ViewState>& to) {
  if (from.empty()) return;
  Session& session = viewer.session();
  session.retouch.begun_at_px.reset();
  const bool painted_anew = from.back().style != session.state.style || from.back().touches != session.state.touches;
  const ViewState now = session.state;
  session.state = from.back();
  session.state.framed = now.framed;
  session.state.head = now.head;
  session.state.orbit = now.orbit;
  session.state.share = now.share;
  session.state.comparison = now.comparison;
  session.state.layers_apart_deg = now.layers_apart_deg;
  session.state.depth_around = now.depth_around;
  to.push_back(now);
  from.pop_back();
  session.zero_parallax_target_px.reset();
  if (painted_anew) viewer.paint();
}

/// What is set by hand.
struct Work {
  Style style;
  std::vector<DepthRegion> depth_regions;
  std::vector<Touch> touches;
  float vertical_px = 0, roll_deg = 0;
  CameraPath camera_path;
  explicit Work(const Session& session)
      : style(session.state.style),
        depth_regions(session.state.depth_regions),
        touches(session.state.touches),
        vertical_px(session.state.adjustment.vertical_px),
        roll_deg(session.state.adjustment.roll_deg),
        camera_path(session.camera_path) {}
  friend bool operator==(const Work&, const Work&) = default;
};

/// What a menu's commands work on.
bool menu_applies(const Viewer& viewer, std::string_view menu) {
  const Session& session = viewer.session();
  if (menu == "File" || menu == "Help" || menu == "Tracking") return true;
  if (menu == "Film") return session.film.has_value();
  if (menu == "Painting") return shows_painting(viewer);
  if (menu == "Particles") return shows_particles(viewer);
  if (menu == "Camera") return turns_around(viewer);
  return shows_something(viewer);
}

}  // namespace

Words words_of(std::string_view line) {
  Words words;
  std::string word;
  bool quoted = false, begun = false;
  for (const char letter : line) {
    if (letter == '"') {
      quoted = !quoted;
      begun = true;
    } else if (letter == '#' && words.empty() && !begun) {
      return {};
    } else if (!quoted && (letter == ' ' || letter == '\t' || letter == '\r')) {
      if (begun) words.push_back(std::exchange(word, {}));
      begun = false;
    } else {
      word += letter;
      begun = true;
    }
  }
  if (quoted) throw Error(ErrorKind::wrong_usage, fmt::format("'{}' has an unclosed quote", line));
  if (begun) words.push_back(std::move(word));
  return words;
}

double number_of(const std::string& word) {
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(number))
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no number", word));
  return number;
}

double number_of(const std::string& word, double least, double most) {
  const double number = number_of(word);
  if (number < least || number > most)
    throw Error(ErrorKind::wrong_usage, fmt::format("{} is out of range, expected {} to {}", word, least, most));
  return number;
}

std::size_t place_among(std::span<const std::string_view> names, const std::string& word, std::string_view what) {
  const auto found = std::ranges::find(names, word);
  if (found == names.end())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("'{}' is no {}, expected one of: {}", word, what, fmt::join(names, ", ")));
  return static_cast<std::size_t>(found - names.begin());
}

bool switch_of(const std::string& word) {
  if (word == "on") return true;
  if (word == "off") return false;
  throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is neither on nor off", word));
}

std::span<const Command> command_table() {
  static const std::vector<Command> table = all_commands();
  return table;
}

std::string readable(std::string_view name) {
  std::string text(name);
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(text.front()));
  std::ranges::replace(text, '-', ' ');
  return text;
}

bool shows_something(const Viewer& viewer) {
  return !std::holds_alternative<std::monostate>(viewer.session().opened.content);
}

bool shows_painting(const Viewer& viewer) {
  return std::holds_alternative<PaintedContent>(viewer.session().opened.content);
}

bool shows_particles(const Viewer& viewer) {
  return std::holds_alternative<ParticlesContent>(viewer.session().opened.content);
}

bool shows_scene(const Viewer& viewer) { return is_scene(viewer.session().opened.content); }

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
  // A preset and a file are chosen again as easily.
  const bool is_work = command.name != "style" && command.name != "camera" && command.name != "open";
  const Work before(session);
  try {
    command.run(viewer, arguments);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", command.name, error.what()));
  }
  if (is_kept) change.keep(session);
  if (is_work && before != Work(session)) session.has_unsaved_work = true;
}

std::string title_of(const Command& command) {
  return std::string(command.text.substr(0, std::min(command.text.find(':'), command.text.find(','))));
}

bool applies(const Viewer& viewer, const Command& command) {
  return command.entry.applies != nullptr ? command.entry.applies(viewer) : menu_applies(viewer, command.menu);
}

std::vector<Choice> choices_of(const Viewer& viewer, const Command& command) {
  if (command.entry.choices != nullptr) return command.entry.choices(viewer);
  std::vector<Choice> choices;
  if (command.arguments.find('|') == std::string_view::npos) return choices;
  std::istringstream words{std::string(command.arguments)};
  for (std::string word; std::getline(words, word, '|');) {
    if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos) return {};
    choices.push_back({word, readable(word)});
  }
  return choices;
}

bool is_toggle(const Command& command) {
  return command.entry.now != nullptr && (command.arguments.empty() || command.arguments == "on|off");
}

void run_line(Viewer& viewer, std::string_view line) {
  const Words words = words_of(line);
  if (!words.empty()) run_command(viewer, find_command(words.front()), {words.begin() + 1, words.end()});
}

void Change::keep(Session& session) const {
  const bool is_moving = session.zero_parallax_target_px && session.zero_parallax_target_px != target_before_;
  if (!is_moving && parameters_of(session.state) == parameters_of(before_)) return;
  constexpr std::size_t most_states = 200;
  if (session.done.size() == most_states) session.done.erase(session.done.begin());
  session.done.push_back(before_);
  session.undone.clear();
}

void undo(Viewer& viewer) { go_back(viewer, viewer.session().done, viewer.session().undone); }
void redo(Viewer& viewer) { go_back(viewer, viewer.session().undone, viewer.session().done); }

}  // namespace wheatstone::viewer
