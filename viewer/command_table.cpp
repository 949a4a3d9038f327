#include "command_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "command_line.h"
#include "pointing.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/marks/style_parameters.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer {
namespace {

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

bool switch_of(const std::string& word) {
  if (word == "on") return true;
  if (word == "off") return false;
  throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is neither on nor off", word));
}

ViewState& state_of(Viewer& viewer) { return viewer.session().state; }

// Files

void step_item(Viewer& viewer, int by) {
  const auto count = static_cast<int>(viewer.session().items.size());
  if (count > 0) viewer.open(static_cast<std::size_t>((static_cast<int>(viewer.session().item) + by + count) % count));
}

void open_files(Viewer& viewer, const Words& words) {
  Session& session = viewer.session();
  session.items.push_back({words.begin(), words.end()});
  viewer.open(session.items.size() - 1);
}

const Frame& frame_of(const Viewer& viewer) {
  if (viewer.frame() == nullptr) throw Error(ErrorKind::wrong_usage, "nothing has been drawn yet");
  return *viewer.frame();
}

void save_painting(Viewer& viewer, const Words& words) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  if (content == nullptr || !content->painting) throw Error(ErrorKind::wrong_usage, "there is no painting to save");
  write_painting(words[0], *content->painting);
  viewer.tell("saved " + words[0]);
}

void save_style(Viewer& viewer, const Words& words) {
  write_whole_file(words[0], style_to_toml(state_of(viewer).style));
  viewer.tell("saved " + words[0]);
}

// Looking

void set_mode(Viewer& viewer, const Words& words) {
  const OutputMode& mode = find_output_mode(words[0]);
  ViewState& state = state_of(viewer);
  if (std::holds_alternative<Lenticular>(mode.kind) && state.screen.empty())
    lenticular_screen_of(find_display(state.display));
  state.mode = mode.name;
}

void step_mode(Viewer& viewer, int by) {
  const auto modes = output_modes();
  const auto count = static_cast<int>(modes.size());
  auto at = static_cast<int>(&find_output_mode(state_of(viewer).mode) - modes.data());
  // What the display cannot show is passed over.
  for (int tried = 0; tried < count; ++tried) {
    at = (at + by + count) % count;
    const bool needs_display = shows_display_views(modes[static_cast<std::size_t>(at)]) ||
                               std::holds_alternative<PageFlip>(modes[static_cast<std::size_t>(at)].kind);
    if (!needs_display) break;
  }
  state_of(viewer).mode = modes[static_cast<std::size_t>(at)].name;
}

/// The place in the content that lies in the middle stays there.
void zoom_by(Viewer& viewer, double factor) {
  const double now = viewer.frame() != nullptr ? viewer.frame()->scale : 1;
  state_of(viewer).framed.zoom = std::clamp(now * factor, 1. / 64, 64.);
}

void zoom_at(Viewer& viewer, const Words& words) {
  const double factor = number_of(words[0], 1. / 64, 64), x = number_of(words[1]), y = number_of(words[2]);
  const Frame& frame = frame_of(viewer);
  const double before = frame.scale;
  zoom_by(viewer, factor);
  Framed& framed = state_of(viewer).framed;
  for (const ViewPlace& place : frame.places) {
    const double in_x = (x - place.left) / place.squeeze_x, in_y = (y - place.top) / place.squeeze_y;
    const double width = place.width / place.squeeze_x, height = place.height / place.squeeze_y;
    if (in_x < 0 || in_y < 0 || in_x >= width || in_y >= height) continue;
    // What is at the pointer stays at the pointer.
    framed.pan_x += (in_x - width / 2) * (1 / before - 1 / framed.zoom);
    framed.pan_y += (in_y - height / 2) * (1 / before - 1 / framed.zoom);
    return;
  }
}

void pan(Viewer& viewer, const Words& words) {
  const double scale = viewer.frame() != nullptr ? viewer.frame()->scale : 1;
  Framed& framed = state_of(viewer).framed;
  framed.pan_x -= number_of(words[0]) / scale;
  framed.pan_y -= number_of(words[1]) / scale;
}

void reset(Viewer& viewer, const Words& /*words*/) {
  ViewState& state = state_of(viewer);
  const ViewState as_new;
  state.framed = as_new.framed;
  state.head = as_new.head;
  state.orbit = as_new.orbit;
  state.finest_layer = as_new.finest_layer;
  state.swap = false;
  state.comparison = as_new.comparison;
  viewer.show_comfortably();
}

// Depth

void ease_zero_parallax(Viewer& viewer, float disparity_px) { viewer.session().zero_parallax_target_px = disparity_px; }

void zero_parallax_at(Viewer& viewer, const Words& words) {
  const std::optional<PlaceInView> place = place_at(frame_of(viewer).places, number_of(words[0]), number_of(words[1]));
  const std::optional<float> disparity =
      place ? disparity_at(viewer.session().opened.content, *place) : std::optional<float>();
  if (!disparity) {
    viewer.tell("the depth is not known there");
    return;
  }
  ease_zero_parallax(viewer, *disparity);
}

void step_zero_parallax(Viewer& viewer, float by_px) {
  Adjustment& adjustment = state_of(viewer).adjustment;
  viewer.session().zero_parallax_target_px.reset();
  adjustment.zero_parallax_px += by_px;
}

// Detail

int layer_count(const Viewer& viewer) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  return content != nullptr && content->painting ? static_cast<int>(layers_of(*content->painting).size()) : 0;
}

void step_detail(Viewer& viewer, int by) {
  const int finest = layer_count(viewer) - 1;
  if (finest < 0) return;
  int& layer = state_of(viewer).finest_layer;
  layer = std::clamp(std::min(layer, finest) + by, 0, finest);
}

// Painting

void set_style(Viewer& viewer, const Words& words) {
  state_of(viewer).style = read_style(words[0]);
  viewer.paint();
}

void set_parameter(Viewer& viewer, const Words& words) {
  const auto parameters = style_parameters();
  const auto found = std::ranges::find(parameters, words[0], &StyleParameter::name);
  if (found == parameters.end())
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no parameter of a style", words[0]));
  Style style = state_of(viewer).style;
  found->set(style, words[1]);
  check_style(style);
  state_of(viewer).style = style;
  viewer.paint();
}

void compare(Viewer& viewer, const Words& words) {
  static constexpr std::array names{std::pair{std::string_view("painting"), Comparison::painting},
                                    std::pair{std::string_view("photograph"), Comparison::photograph},
                                    std::pair{std::string_view("split"), Comparison::split}};
  for (const auto& [name, comparison] : names)
    if (name == words[0]) {
      state_of(viewer).comparison = comparison;
      return;
    }
  throw Error(ErrorKind::wrong_usage,
              fmt::format("'{}' is nothing to compare, expected painting, photograph or split", words[0]));
}

void go_back(Viewer& viewer, std::vector<ViewState>& from, std::vector<ViewState>& to) {
  if (from.empty()) return;
  Session& session = viewer.session();
  const bool painted_anew = from.back().style != session.state.style;
  const ViewState now = session.state;
  session.state = from.back();
  session.state.framed = now.framed;
  session.state.head = now.head;
  session.state.orbit = now.orbit;
  to.push_back(now);
  from.pop_back();
  session.zero_parallax_target_px.reset();
  if (painted_anew) viewer.paint();
}

// Particles

void orbit(Viewer& viewer, const Words& words) {
  Framing& framing = state_of(viewer).orbit;
  framing.azimuth_deg = static_cast<float>(std::remainder(framing.azimuth_deg + number_of(words[0]), 360));
  framing.elevation_deg = static_cast<float>(std::clamp(framing.elevation_deg + number_of(words[1]), -89., 89.));
}

constexpr double zoom_step = 1.25;
constexpr float head_step = 0.1f;

constexpr Command table[] = {
    // name, arguments, menu, text, keys
    {"open", "FILE [RIGHT]", "File", "Open…", "Ctrl+O", open_files},
    {"next-file", "", "File", "Next file", "PgDown", [](Viewer& v, const Words&) { step_item(v, 1); }},
    {"previous-file", "", "File", "Previous file", "PgUp", [](Viewer& v, const Words&) { step_item(v, -1); }},
    {"save-picture", "FILE", "File", "Save picture…", "Ctrl+S",
     [](Viewer& v, const Words& w) {
       write_image(w[0], frame_of(v).picture);
       v.tell("saved " + w[0]);
     }},
    {"save-painting", "FILE", "File", "Save painting…", "Ctrl+Shift+S", save_painting},
    {"save-style", "FILE", "File", "Save style…", "", save_style},
    {"copy-command", "", "File", "Copy command", "Ctrl+Shift+C",
     [](Viewer& v, const Words&) { v.tell(command_line_of(v.session())); }},
    {"quit", "", "File", "Quit", "Q, Ctrl+Q", [](Viewer& v, const Words&) { v.session().ends = true; }},

    {"mode", "NAME", "View", "Output mode", "", set_mode},
    {"next-mode", "", "View", "Next output mode", "T", [](Viewer& v, const Words&) { step_mode(v, 1); }},
    {"previous-mode", "", "View", "Previous output mode", "Shift+T", [](Viewer& v, const Words&) { step_mode(v, -1); }},
    {"swap", "", "View", "Swap eyes", "W", [](Viewer& v, const Words&) { state_of(v).swap = !state_of(v).swap; }},
    {"full-screen", "", "View", "Full screen", "F, F11",
     [](Viewer& v, const Words&) { v.session().full_screen = !v.session().full_screen; }},
    {"zoom", "FACTOR", "View", "Zoom: screen pixels for one of the picture", "",
     [](Viewer& v, const Words& w) { state_of(v).framed.zoom = number_of(w[0], 1. / 64, 64); }},
    {"zoom-at", "FACTOR X Y", "View", "Zoom around a place on the screen", "", zoom_at},
    {"zoom-in", "", "View", "Zoom in", "+, =", [](Viewer& v, const Words&) { zoom_by(v, zoom_step); }},
    {"zoom-out", "", "View", "Zoom out", "-", [](Viewer& v, const Words&) { zoom_by(v, 1 / zoom_step); }},
    {"fit", "", "View", "Fit into the window", "0", [](Viewer& v, const Words&) { state_of(v).framed = {}; }},
    {"actual-size", "", "View", "Actual size", "1", [](Viewer& v, const Words&) { state_of(v).framed.zoom = 1; }},
    {"pan", "X Y", "View", "Move the picture, in screen pixels", "", pan},
    {"reset", "", "View", "Reset the view", "Backspace", reset},
    {"leave", "", "View", "Leave full screen, or quit", "Esc",
     [](Viewer& v, const Words&) {
       Session& session = v.session();
       (session.full_screen ? session.full_screen : session.ends) = !session.full_screen;
     }},
    {"information", "", "View", "Information", "I",
     [](Viewer& v, const Words&) { v.session().information = !v.session().information; }},

    {"zero-parallax", "DISPARITY", "Depth", "Disparity on the screen plane, in pixels", "",
     [](Viewer& v, const Words& w) { ease_zero_parallax(v, static_cast<float>(number_of(w[0], -65535, 65535))); }},
    {"zero-parallax-at", "X Y", "Depth", "Bring what lies at a place onto the screen plane", "", zero_parallax_at},
    {"nearer", "", "Depth", "Bring the scene nearer", "Alt+Left, /",
     [](Viewer& v, const Words&) { step_zero_parallax(v, -1); }},
    {"farther", "", "Depth", "Move the scene farther away", "Alt+Right, *",
     [](Viewer& v, const Words&) { step_zero_parallax(v, 1); }},
    {"separation", "EYES", "Depth", "Distance of the eyes, in those of the picture", "",
     [](Viewer& v, const Words& w) { state_of(v).adjustment.separation = static_cast<float>(number_of(w[0], 0, 10)); }},
    {"comfortable", "", "Depth", "Comfortable depth", "Home", [](Viewer& v, const Words&) { v.show_comfortably(); }},
    {"vertical", "PIXELS", "Depth", "Move the right eye's picture down, in screen pixels", "",
     [](Viewer& v, const Words& w) {
       state_of(v).adjustment.vertical_px = static_cast<float>(number_of(w[0], -1000, 1000));
     }},
    {"roll", "DEGREES", "Depth", "Turn the right eye's picture clockwise", "",
     [](Viewer& v, const Words& w) { state_of(v).adjustment.roll_deg = static_cast<float>(number_of(w[0], -45, 45)); }},
    {"head", "X", "Depth", "Position of the head, in eye separations", "",
     [](Viewer& v, const Words& w) { state_of(v).head = static_cast<float>(number_of(w[0], -100, 100)); }},
    {"head-left", "", "Depth", "Move the head to the left", "Left",
     [](Viewer& v, const Words&) { state_of(v).head -= head_step; }},
    {"head-right", "", "Depth", "Move the head to the right", "Right",
     [](Viewer& v, const Words&) { state_of(v).head += head_step; }},
    {"display", "NAME", "Depth", "Display", "",
     [](Viewer& v, const Words& w) { state_of(v).display = find_display(w[0]).name; }},
    {"screen", "NAME|FILE", "Depth", "Lenticular screen, or its calibration", "",
     [](Viewer& v, const Words& w) {
       find_lenticular(w[0]);
       state_of(v).screen = w[0];
     }},
    {"lens-simulator", "on|off", "Depth", "Show what the eyes see through the display's lenses", "",
     [](Viewer& v, const Words& w) { state_of(v).quantised = switch_of(w[0]); }},

    {"finest-layer", "NUMBER", "Painting", "Finest layer of strokes that is shown, from 0, the coarsest", "",
     [](Viewer& v, const Words& w) { state_of(v).finest_layer = static_cast<int>(number_of(w[0], 0, 1000)); }},
    {"less-detail", "", "Painting", "Less detail", "[", [](Viewer& v, const Words&) { step_detail(v, -1); }},
    {"more-detail", "", "Painting", "More detail", "]", [](Viewer& v, const Words&) { step_detail(v, 1); }},
    {"style", "NAME|FILE", "Painting", "Style", "", set_style},
    {"set", "PARAMETER VALUE", "Painting", "Change a parameter of the style", "", set_parameter},
    {"compare", "painting|photograph|split", "Painting", "Compare with the photograph", "", compare},
    {"undo", "", "Painting", "Undo", "Ctrl+Z",
     [](Viewer& v, const Words&) { go_back(v, v.session().done, v.session().undone); }},
    {"redo", "", "Painting", "Redo", "Ctrl+Shift+Z",
     [](Viewer& v, const Words&) { go_back(v, v.session().undone, v.session().done); }},

    {"orbit", "AZIMUTH ELEVATION", "Particles", "Turn around the particles, in degrees", "", orbit},
    {"magnify", "FACTOR", "Particles", "Magnification of particles", "",
     [](Viewer& v, const Words& w) { state_of(v).orbit.zoom = static_cast<float>(number_of(w[0], 0.01, 1e6)); }},

    {"help", "", "Help", "Keys and commands", "?, F1",
     [](Viewer& v, const Words&) { v.session().help = !v.session().help; }},
};

/// What can be undone of a state: not where one looks from.
ViewState parameters_of(ViewState state) {
  const ViewState as_new;
  state.framed = as_new.framed;
  state.head = as_new.head;
  state.orbit = as_new.orbit;
  state.step = as_new.step;
  return state;
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

std::span<const Command> command_table() { return table; }

const Command& find_command(std::string_view name) {
  const auto* const found = std::ranges::find(table, name, &Command::name);
  if (found != std::end(table)) return *found;
  throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no command of the viewer; see --commands", name));
}

void run_command(Viewer& viewer, const Command& command, const Words& arguments) {
  const WordCount wanted = words_wanted(command);
  if (arguments.size() < wanted.least || arguments.size() > wanted.most)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: has {} arguments, expected {}", command.name, arguments.size(),
                                                    command.arguments.empty() ? "none" : command.arguments));
  Session& session = viewer.session();
  const ViewState before = session.state;
  const std::optional<float> target_before = session.zero_parallax_target_px;
  const bool travels_in_time = command.name == "undo" || command.name == "redo";
  try {
    command.run(viewer, arguments);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", command.name, error.what()));
  }
  const bool is_moving =
      session.zero_parallax_target_px != target_before && session.zero_parallax_target_px.has_value();
  if (travels_in_time || (!is_moving && parameters_of(session.state) == parameters_of(before))) return;
  constexpr std::size_t most_states = 200;
  if (session.done.size() == most_states) session.done.erase(session.done.begin());
  session.done.push_back(before);
  session.undone.clear();
}

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
  if (quoted) throw Error(ErrorKind::wrong_usage, fmt::format("'{}' has a quote that is not closed", line));
  if (begun) words.push_back(std::move(word));
  return words;
}

void run_line(Viewer& viewer, std::string_view line) {
  const Words words = words_of(line);
  if (!words.empty()) run_command(viewer, find_command(words.front()), {words.begin() + 1, words.end()});
}

}  // namespace wheatstone::viewer
