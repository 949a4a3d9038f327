#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "command_table.h"
#include "depth_seen.h"
#include "inputs.h"
#include "orbit.h"
#include "output_mode.h"
#include "particle_scene.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

/// The mode is that in which other files of this kind are opened, too.
void take_mode(Viewer& viewer, std::string_view mode) {
  Session& session = viewer.session();
  session.state.mode = mode;
  const Content& content = session.opened.content;
  if (has_one_view(content)) return;
  const bool is_empty = std::holds_alternative<std::monostate>(content);
  if (is_empty || !is_scene(content)) session.usual_modes.pictures = mode;
  if (is_empty || is_scene(content)) session.usual_modes.scenes = mode;
}

void look_with(Viewer& viewer, const Words& words) {
  const LookingWith& device = find_device(words[0]);
  Session& session = viewer.session();
  session.device = device.name;
  if (!device.display.empty()) session.state.display = device.display;
  session.usual_modes = {std::string(device.mode), std::string(device.mode)};
  if (!has_one_view(session.opened.content)) session.state.mode = device.mode;
}

void set_mode(Viewer& viewer, const Words& words) {
  const OutputMode& mode = find_output_mode(words[0]);
  ViewState& state = state_of(viewer);
  if (std::holds_alternative<PageFlip>(mode.kind) && !viewer.session().stereo)
    throw Error(ErrorKind::wrong_usage, "page-flip needs a graphics card with stereo, asked for by --stereo");
  if (std::holds_alternative<Lenticular>(mode.kind) && state.screen.empty())
    lenticular_screen_of(find_display(state.display));
  take_mode(viewer, mode.name);
}

void step_mode(Viewer& viewer, int by) {
  const auto modes = output_modes();
  const auto count = static_cast<int>(modes.size());
  auto at = static_cast<int>(&find_output_mode(state_of(viewer).mode) - modes.data());
  // What the display cannot show is passed over.
  for (int tried = 0; tried < count; ++tried) {
    at = (at + by + count) % count;
    const bool needs_display =
        shows_display_views(modes[static_cast<std::size_t>(at)]) ||
        (std::holds_alternative<PageFlip>(modes[static_cast<std::size_t>(at)].kind) && !viewer.session().stereo);
    if (!needs_display) break;
  }
  take_mode(viewer, modes[static_cast<std::size_t>(at)].name);
}

/// Screen pixels for one of the content. Frames come later than what is set: only what fits is known from them alone.
double scale_of(Viewer& viewer) {
  if (state_of(viewer).framed.zoom > 0) return state_of(viewer).framed.zoom;
  return viewer.frame() != nullptr ? viewer.frame()->scale : 1;
}

/// The place in the content that lies in the middle stays there.
void zoom_by(Viewer& viewer, double factor) {
  if (magnify_orbit(viewer, factor)) return;
  state_of(viewer).framed.zoom = std::clamp(scale_of(viewer) * factor, 1. / 64, 64.);
}

void zoom_at(Viewer& viewer, const Words& words) {
  const double factor = number_of(words[0], 1. / 64, 64), x = number_of(words[1]), y = number_of(words[2]);
  const Frame& frame = frame_of(viewer);
  const double before = scale_of(viewer);
  if (!turns_around(viewer)) zoom_by(viewer, factor);
  Framed& framed = state_of(viewer).framed;
  for (const ViewPlace& place : frame.places) {
    const double in_x = (x - place.left) / place.squeeze_x, in_y = (y - place.top) / place.squeeze_y;
    const double width = place.width / place.squeeze_x, height = place.height / place.squeeze_y;
    if (in_x < 0 || in_y < 0 || in_x >= width || in_y >= height) continue;
    // What is at the pointer stays at the pointer.
    if (magnify_orbit(viewer, factor, in_x - width / 2, in_y - height / 2)) return;
    framed.pan_x += (in_x - width / 2) * (1 / before - 1 / framed.zoom);
    framed.pan_y += (in_y - height / 2) * (1 / before - 1 / framed.zoom);
    return;
  }
}

void pan(Viewer& viewer, const Words& words) {
  if (pan_orbit(viewer, number_of(words[0]), number_of(words[1]))) return;
  const double scale = scale_of(viewer);
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
  state.slicing = as_new.slicing;
  state.swap = false;
  state.comparison = as_new.comparison;
  viewer.show_comfortably();
}

std::vector<Choice> device_choices(const Viewer& /*viewer*/) {
  std::vector<Choice> choices;
  for (const LookingWith& device : devices()) choices.push_back({std::string(device.name), std::string(device.text)});
  return choices;
}

/// Those that the screen can show.
std::vector<Choice> mode_choices(const Viewer& viewer) {
  std::vector<Choice> choices;
  for (const OutputMode& mode : output_modes())
    if (viewer.session().stereo || !std::holds_alternative<PageFlip>(mode.kind)) {
      choices.push_back({std::string(mode.name), mode.text});
      char& first = choices.back().text.front();
      first = static_cast<char>(std::toupper(first));
    }
  return choices;
}

std::vector<Choice> screen_choices(const Viewer& viewer) {
  std::vector<Choice> choices;
  for (int screen = 1; screen <= viewer.session().screens; ++screen)
    choices.push_back({fmt::format("{}", screen), fmt::format("Screen {}", screen)});
  return choices;
}

void fill_screen(Viewer& viewer, const Words& words) {
  Session& session = viewer.session();
  const double number = number_of(words[0]);
  if (number != std::floor(number) || number < 1 || number > session.screens)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("there is no screen {}, expected 1 to {}", words[0], session.screens));
  session.screen = static_cast<int>(number);
  session.full_screen = true;
}

constexpr double zoom_step = 1.25;

constexpr Command looking_table[] = {
    // name, arguments, menu, text, keys
    {"look-with",
     "DEVICE",
     "View",
     "What do you look with?",
     "",
     look_with,
     {.choices = device_choices, .now = [](const Viewer& v) { return v.session().device; }}},
    {"mode",
     "NAME",
     "View",
     "Output mode",
     "",
     set_mode,
     {.choices = mode_choices, .now = [](const Viewer& v) { return v.session().state.mode; }, .icon = "mode"}},
    {"next-mode", "", "View", "Next output mode", "T", [](Viewer& v, const Words&) { step_mode(v, 1); }},
    {"previous-mode", "", "View", "Previous output mode", "Shift+T", [](Viewer& v, const Words&) { step_mode(v, -1); }},
    {"swap",
     "",
     "View",
     "Swap eyes",
     "W",
     [](Viewer& v, const Words&) { state_of(v).swap = !state_of(v).swap; },
     {.now = [](const Viewer& v) { return on_or_off(v.session().state.swap); }}},
    {"theme",
     "desktop|light|dark",
     "View",
     "Colours of the window",
     "",
     [](Viewer& v, const Words& w) { v.session().theme = static_cast<Theme>(place_among(theme_names, w[0], "theme")); },
     {.now = [](const Viewer& v) { return std::string(theme_names[static_cast<std::size_t>(v.session().theme)]); },
      .applies = [](const Viewer&) { return true; }}},
    {"full-screen",
     "",
     "View",
     "Full screen",
     "F, F11",
     [](Viewer& v, const Words&) { v.session().full_screen = !v.session().full_screen; },
     {.now = [](const Viewer& v) { return on_or_off(v.session().full_screen); },
      .applies = [](const Viewer&) { return true; },
      .icon = "full-screen",
      .begins_group = true}},
    {"full-screen-on",
     "NUMBER",
     "View",
     "Full screen on",
     "",
     fill_screen,
     {.choices = screen_choices, .applies = [](const Viewer& v) { return v.session().screens > 1; }}},
    {"zoom", "FACTOR", "View", "Zoom: screen pixels for one picture pixel", "",
     [](Viewer& v, const Words& w) { state_of(v).framed.zoom = number_of(w[0], 1. / 64, 64); }},
    {"zoom-at", "FACTOR X Y", "View", "Zoom around a place on the screen", "", zoom_at},
    {"zoom-in",
     "",
     "View",
     "Zoom in",
     "+, =",
     [](Viewer& v, const Words&) { zoom_by(v, zoom_step); },
     {.begins_group = true}},
    {"zoom-out", "", "View", "Zoom out", "-", [](Viewer& v, const Words&) { zoom_by(v, 1 / zoom_step); }},
    {"fit", "", "View", "Fit into the window", "0",
     [](Viewer& v, const Words&) {
       if (!fit_orbit(v)) state_of(v).framed = {};
     }},
    {"actual-size", "", "View", "Actual size", "1", [](Viewer& v, const Words&) { state_of(v).framed.zoom = 1; }},
    {"pan", "X Y", "View", "Move the picture, in screen pixels", "", pan},
    {"reset", "", "View", "Reset the view", "Backspace", reset},
    {"leave",
     "",
     "View",
     "Close the help, end the slideshow, or leave full screen",
     "Esc",
     [](Viewer& v, const Words&) {
       Session& session = v.session();
       if (!session.help && session.slideshow_s > 0) {
         session.slideshow_s = 0;
         return;
       }
       (session.help ? session.help : session.full_screen) = false;
     },
     {.applies =
          [](const Viewer& v) { return v.session().full_screen || v.session().help || v.session().slideshow_s > 0; },
      .begins_group = true}},
    {"information",
     "",
     "View",
     "Information",
     "I",
     [](Viewer& v, const Words&) { v.session().information = !v.session().information; },
     {.now = [](const Viewer& v) { return on_or_off(v.session().information); }}},
    {"help",
     "",
     "Help",
     "Keys and commands",
     "?, F1",
     [](Viewer& v, const Words&) { v.session().help = !v.session().help; },
     {.now = [](const Viewer& v) { return on_or_off(v.session().help); }}},
};

void track_head(Viewer& viewer, const Words& words) {
  std::optional<std::uint16_t> port;
  if (words[0] != "off") {
    const double number = number_of(words[0], 0, 65535);
    if (number != std::floor(number)) throw Error(ErrorKind::wrong_usage, "expected a UDP port or off");
    port = static_cast<std::uint16_t>(number);
  }
  viewer.inputs().track_head(port, viewer.session());
}

void follow_gaze(Viewer& viewer, const Words& words) {
  if (words[0] != "pointer" && words[0] != "off")
    throw Error(ErrorKind::wrong_usage, "'" + words[0] + "' cannot be followed, expected pointer or off");
  viewer.session().gaze_follows_pointer = words[0] == "pointer";
  viewer.session().fixation.reset();
}

void deepen_gaze(Viewer& viewer, const Words& words) {
  constexpr double most = 4;
  set_gaze_gains(viewer.session(),
                 {static_cast<float>(number_of(words[0], 0, most)), static_cast<float>(number_of(words[1], 0, most))});
  const Content& content = viewer.session().opened.content;
  if (!can_bend(content) && !has_focus(content))
    viewer.tell("more depth at the gaze point needs particles, slices, or a painting of strokes or lines");
}

std::vector<Choice> tracker_choices(const Viewer& /*viewer*/) {
  return {{"off", "Off"}, {"4242", "OpenTrack, port 4242"}};
}

std::string tracker_port(const Session& session) {
  return session.tracked_head ? fmt::format("{}", session.tracked_head->port) : "off";
}

std::vector<Choice> gaze_choices(const Viewer& /*viewer*/) {
  return {{"1 1", "The same depth everywhere"}, {"1.5 0.5", "1.5 times the depth there, half of it elsewhere"}};
}

std::string gaze_gains_told(const Viewer& viewer) {
  return fmt::format("{} {}", viewer.session().gaze_gains.there, viewer.session().gaze_gains.elsewhere);
}

constexpr double longest_smoothing_s = 2, longest_prediction_s = 0.5;

constexpr Command input_table[] = {
    // name, arguments, menu, text, keys
    {"head-tracker",
     "PORT|off",
     "Tracking",
     "Head tracker: follow the head position that OpenTrack sends to a UDP port (4242)",
     "",
     track_head,
     {.choices = tracker_choices, .now = [](const Viewer& v) { return tracker_port(v.session()); }}},
    {"head-smoothing",
     "SECONDS",
     "Tracking",
     "Smoothing: time over which the tracked head position is smoothed",
     "",
     [](Viewer& v, const Words& w) { v.session().head_filter.smoothing_s = number_of(w[0], 0, longest_smoothing_s); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().head_filter.smoothing_s); },
      .range = {0, 1, 0.05}}},
    {"head-prediction",
     "SECONDS",
     "Tracking",
     "Prediction: how far ahead the tracked head position is predicted",
     "",
     [](Viewer& v, const Words& w) { v.session().head_filter.prediction_s = number_of(w[0], 0, longest_prediction_s); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().head_filter.prediction_s); },
      .range = {0, 0.2, 0.01}}},
    {"gaze", "X Y", "Tracking", "Set the gaze point, in picture pixels", "",
     [](Viewer& v, const Words& w) {
       frame_of(v);
       look_at(v, number_of(w[0]), number_of(w[1]));
     }},
    {"gaze-follows",
     "pointer|off",
     "Tracking",
     "Gaze: take the pointer as the gaze point, which the screen plane follows",
     "",
     follow_gaze,
     {.now =
          [](const Viewer& v) {
            return v.session().gaze_follows_pointer ? std::string("pointer") : std::string("off");
          },
      .begins_group = true}},
    {"gaze-depth",
     "THERE ELSEWHERE",
     "Tracking",
     "Depth at the gaze point: there and elsewhere, 1.5 0.5; 1 1 for none",
     "",
     deepen_gaze,
     {.choices = gaze_choices, .now = gaze_gains_told}},
};

}  // namespace

std::span<const Command> looking_commands() { return looking_table; }

std::span<const Command> input_commands() { return input_table; }

}  // namespace wheatstone::viewer
