// What of particles is shown, how, and where there is more depth.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "command_table.h"
#include "orbit.h"
#include "particle_scene.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

/// "auto", or a number.
std::optional<float> number_or_auto(const std::string& word, double least, double most) {
  if (word == "auto") return {};
  return static_cast<float>(number_of(word, least, most));
}

void set_colours(Viewer& viewer, const Words& words) {
  const std::string name = words[0] == "auto" ? std::string() : words[0];
  make_splat_style({.colour_map = name}, {});  // which there is
  state_of(viewer).look.colours = name;
}

void set_splat(Viewer& viewer, const Words& words) {
  const std::size_t comma = words[0].find(',');
  if (comma == std::string::npos)
    throw Error(ErrorKind::wrong_usage, fmt::format("is '{}', expected MIN,MAX", words[0]));
  const auto smallest = static_cast<float>(number_of(words[0].substr(0, comma), 0.01, SplatStyle::widest_px));
  const auto largest = static_cast<float>(number_of(words[0].substr(comma + 1), 0.01, SplatStyle::widest_px));
  if (smallest > largest)
    throw Error(ErrorKind::wrong_usage, fmt::format("is '{}', expected MIN,MAX with MIN <= MAX", words[0]));
  state_of(viewer).look.smallest_px = smallest;
  state_of(viewer).look.largest_px = largest;
}

/// Changes where the colours begin or end. Throws where the colours would end before they begin.
void set_limit(Viewer& viewer, std::optional<float> ParticleLook::*limit, const std::string& word) {
  ViewState changed = state_of(viewer);
  changed.look.*limit = number_or_auto(word, -1e30, 1e30);
  if (const Particles* const particles = open_particles(viewer)) particle_scene(*particles, changed, eyes_of(viewer));
  state_of(viewer).look = changed.look;
}

/// Changes how deep particles or slices stand. Throws where a display cannot show it.
void set_depth(Viewer& viewer, std::optional<float> ParticleLook::*length_mm, const std::string& word) {
  ViewState changed = state_of(viewer);
  changed.look.*length_mm = number_or_auto(word, 0, 1e9);
  mapping_for(perceived_depth(changed), eyes_of(viewer).width, 1, 2);
  state_of(viewer).look = changed.look;
}

std::string depth_now(const Viewer& viewer, std::optional<float> ParticleLook::*length_mm) {
  const std::optional<float>& length = viewer.session().state.look.*length_mm;
  return length ? fmt::format("{}", *length) : "auto";
}

/// For what has no effect on mass. Throws Error{wrong_usage} where that is shown.
ParticleLook& thesis_look_of(Viewer& viewer) {
  ParticleLook& look = state_of(viewer).look;
  if (drawn_look(look) != Look::thesis) throw Error(ErrorKind::wrong_usage, "it works with 'look thesis'");
  return look;
}

/// Changes what stands beside the scale and colour bars, and shows them. Throws where it cannot be drawn.
void set_annotation(Viewer& viewer, const std::string& title, float behind_mm) {
  ViewState changed = state_of(viewer);
  changed.look.annotated = true;
  changed.look.title = title;
  changed.look.annotation_behind_mm = behind_mm;
  check_annotation({.title = title, .behind_mm = behind_mm}, perceived_depth(changed).viewing);
  state_of(viewer).look = changed.look;
}

void set_title(Viewer& viewer, const Words& words) {
  set_annotation(viewer, words[0] == "off" ? std::string() : words[0], state_of(viewer).look.annotation_behind_mm);
}

void set_annotation_depth(Viewer& viewer, const Words& words) {
  set_annotation(viewer, state_of(viewer).look.title, static_cast<float>(number_of(words[0], -1e4, 1e5)));
}

void set_opaque(Viewer& viewer, const Words& words) {
  ParticleLook& look = state_of(viewer).look;
  look.opaque = switch_of(words[0]);
  forget_brightness(look);
}

bool shows_light(const Viewer& viewer) {
  return shows_particles(viewer) && drawn_look(viewer.session().state.look) == Look::thesis;
}

/// A text, or what stands for none.
std::string told_or(const char* none, const std::string& text) { return text.empty() ? none : text; }

std::vector<Choice> colour_choices(const Viewer& /*viewer*/) {
  std::vector<Choice> choices{{"auto", "Automatic"}};
  for (const std::string_view name : colour_map_names()) choices.push_back({std::string(name), readable(name)});
  return choices;
}

constexpr Command particle_table[] = {
    // name, arguments, menu, text, keys
    {"exposure",
     "VALUE|auto",
     "Particles",
     "Exposure: factor on the light",
     "",
     [](Viewer& v, const Words& w) { thesis_look_of(v).exposure = number_or_auto(w[0], 1e-9, 1e9); },
     {.now =
          [](const Viewer& v) {
            return v.session().state.look.exposure ? fmt::format("{}", *v.session().state.look.exposure)
                                                   : std::string("auto");
          },
      .applies = shows_light}},
    {"colours",
     "NAME|auto",
     "Particles",
     "Colour map",
     "",
     set_colours,
     {.choices = colour_choices,
      .now = [](const Viewer& v) { return told_or("auto", v.session().state.look.colours); }}},
    {"coldest", "VALUE|auto", "Particles", "Temperature where the colours begin", "",
     [](Viewer& v, const Words& w) { set_limit(v, &ParticleLook::coldest, w[0]); }},
    {"hottest", "VALUE|auto", "Particles", "Temperature where the colours end", "",
     [](Viewer& v, const Words& w) { set_limit(v, &ParticleLook::hottest, w[0]); }},
    {"splat", "MIN,MAX", "Particles", "Smallest and largest diameter of a splat, in pixels", "", set_splat},
    {"opacity",
     "VALUE",
     "Particles",
     "Opacity of the densest particles",
     "",
     [](Viewer& v, const Words& w) { thesis_look_of(v).opacity = static_cast<float>(number_of(w[0], 1e-6, 1000)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.look.opacity); },
      .range = {0.05, 4, 0.05},
      .applies = shows_light}},
    {"opaque",
     "on|off",
     "Particles",
     "Opaque particles: the nearest hides the others",
     "",
     set_opaque,
     {.now = [](const Viewer& v) { return on_or_off(v.session().state.look.opaque); }}},
    {"near",
     "MM|auto",
     "Particles",
     "Depth before the screen: of particles, a model or slices, in mm",
     "",
     [](Viewer& v, const Words& w) { set_depth(v, &ParticleLook::near_mm, w[0]); },
     {.now = [](const Viewer& v) { return depth_now(v, &ParticleLook::near_mm); },
      .range = {0, 200, 5},
      .applies = shows_scene}},
    {"far",
     "MM|auto",
     "Particles",
     "Depth behind the screen: of particles, a model or slices, in mm",
     "",
     [](Viewer& v, const Words& w) { set_depth(v, &ParticleLook::far_mm, w[0]); },
     {.now = [](const Viewer& v) { return depth_now(v, &ParticleLook::far_mm); },
      .range = {0, 500, 5},
      .applies = shows_scene}},
};

template <class Value, std::size_t count>
Value one_of(const std::array<std::pair<std::string_view, Value>, count>& choices, const std::string& word) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  throw Error(ErrorKind::wrong_usage, fmt::format("is '{}', expected one of: {}", word, names));
}

void set_look(Viewer& viewer, const Words& words) {
  static constexpr std::array looks{std::pair{std::string_view("mass"), Look::mass},
                                    std::pair{std::string_view("thesis"), Look::thesis}};
  ParticleLook& look = state_of(viewer).look;
  look.look = one_of(looks, words[0]);
  forget_brightness(look);
}

void set_where(Viewer& viewer, const Words& words) {
  const std::string where = words[0] == "all" ? std::string() : words[0];
  if (!where.empty()) parse_condition(where);
  ParticleLook& look = state_of(viewer).look;
  look.choice.where = where;
  forget_brightness(look);
}

void set_type_colours(Viewer& viewer, const Words& words) {
  const std::string types = words[0] == "off" ? std::string() : words[0];
  if (!types.empty()) parse_type_colours(types);
  ParticleLook& look = state_of(viewer).look;
  look.choice.type_colours = types;
  look.choice.quantity.clear();
  forget_brightness(look);
}

void set_quantity(Viewer& viewer, const Words& words) {
  ParticleLook& look = state_of(viewer).look;
  look.choice.quantity = words[0] == "picture" ? std::string() : words[0];
  look.choice.type_colours.clear();
  look.look = Look::mass;
  look.opaque = false;
  forget_brightness(look);
}

void set_stretch(Viewer& viewer, const Words& words) {
  static constexpr std::array stretches{std::pair{std::string_view("asinh"), Stretch::asinh},
                                        std::pair{std::string_view("log"), Stretch::log},
                                        std::pair{std::string_view("linear"), Stretch::linear}};
  ParticleLook& look = state_of(viewer).look;
  look.stretch = one_of(stretches, words[0]);
  forget_brightness(look);
}

/// Changes where brightness begins or ends. Throws where it would end before it begins.
void set_brightness(Viewer& viewer, std::optional<float> ParticleLook::*limit, const std::string& word) {
  ParticleLook look = state_of(viewer).look;
  look.*limit = word == "auto" ? std::nullopt : std::optional(static_cast<float>(number_of(word, -1e30, 1e30)));
  if (look.least && look.most && !(*look.least < *look.most))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("brightness begins at {} and ends at {}, expected the end above the beginning", *look.least,
                            *look.most));
  if (look.stretch == Stretch::log && look.least && *look.least <= 0)
    throw Error(ErrorKind::wrong_usage, fmt::format("is {}, expected above 0 with stretch log", *look.least));
  state_of(viewer).look = look;
}

bool shows_focus(const Viewer& viewer) { return has_focus(viewer.session().opened.content); }

void change_focus(Viewer& viewer, const ScreenFocus& focus) {
  if (!shows_focus(viewer) && shows_something(viewer))
    throw Error(ErrorKind::wrong_usage, "there are no particles or slices; 'gaze-depth' is for paintings");
  check_focus_in(viewer, focus);
  viewer.session().focus_target.reset();
  state_of(viewer).look.focus = focus;
}

void set_focus(Viewer& viewer, const Words& words) {
  ScreenFocus focus = state_of(viewer).look.focus;
  const std::size_t comma = words[0].find(',');
  if (words[0] == "off") {
    focus.at.reset();
  } else if (comma == std::string::npos) {
    throw Error(ErrorKind::wrong_usage, fmt::format("is '{}', expected X,Y from 0 to 1, or off", words[0]));
  } else {
    focus.at = {static_cast<float>(number_of(words[0].substr(0, comma), 0, 1)),
                static_cast<float>(number_of(words[0].substr(comma + 1), 0, 1))};
  }
  change_focus(viewer, focus);
}

void focus_at(Viewer& viewer, const Words& words) {
  const std::optional<PlaceInView> place = place_at(frame_of(viewer).places, number_of(words[0]), number_of(words[1]));
  const PictureSize size = size_of_view(viewer);
  if (!place || place->x < 0 || place->y < 0 || place->x > size.width || place->y > size.height) return;
  ScreenFocus focus = state_of(viewer).look.focus;
  focus.at = {static_cast<float>(place->x / size.width), static_cast<float>(place->y / size.height)};
  change_focus(viewer, focus);
}

void set_focus_number(Viewer& viewer, float ScreenFocus::*number, double value) {
  ScreenFocus focus = state_of(viewer).look.focus;
  focus.*number = static_cast<float>(value);
  change_focus(viewer, focus);
}

std::string stretch_told(const Viewer& viewer) {
  switch (viewer.session().state.look.stretch) {
    case Stretch::log:
      return "log";
    case Stretch::linear:
      return "linear";
    default:
      return "asinh";
  }
}

std::vector<Choice> quantity_choices(const Viewer& /*viewer*/) {
  return {{"picture", "Mass, temperature"}, {"column-density", "Column density"}};
}

std::string quantity_told(const Viewer& viewer) {
  return told_or("picture", viewer.session().state.look.choice.quantity);
}

constexpr Command quantity_table[] = {
    // name, arguments, menu, text, keys
    {"look",
     "mass|thesis",
     "Particles",
     "Look: mass, or the light of the thesis",
     "",
     set_look,
     {.now =
          [](const Viewer& v) {
            return drawn_look(v.session().state.look) == Look::thesis ? std::string("thesis") : std::string("mass");
          }}},
    {"quantity",
     "NAME|column-density|mean:temperature|picture",
     "Particles",
     "Quantity: the column density, or the mean of a dataset along each line of sight",
     "",
     set_quantity,
     {.choices = quantity_choices, .now = quantity_told}},
    {"where",
     "CONDITION|all",
     "Particles",
     "Only where: a condition for particles, as \"Temperature > 1e6 and Density < 1e-3\"",
     "",
     set_where,
     {.now = [](const Viewer& v) { return told_or("all", v.session().state.look.choice.where); }, .is_text = true}},
    {"type-colours",
     "TYPES|off",
     "Particles",
     "Types in colours: several types of a snapshot, as gas=FFB347:6,halo=3B5BDB",
     "",
     set_type_colours,
     {.now = [](const Viewer& v) { return told_or("off", v.session().state.look.choice.type_colours); },
      .is_text = true}},
    {"stretch",
     "asinh|log|linear",
     "Particles",
     "Stretch: how numbers become brightness",
     "",
     set_stretch,
     {.now = stretch_told}},
    {"least", "VALUE|auto", "Particles", "Column density, or quantity, where brightness begins", "",
     [](Viewer& v, const Words& w) { set_brightness(v, &ParticleLook::least, w[0]); }},
    {"most", "VALUE|auto", "Particles", "Column density, or quantity, where brightness ends", "",
     [](Viewer& v, const Words& w) { set_brightness(v, &ParticleLook::most, w[0]); }},
    {"annotate",
     "on|off",
     "Particles",
     "Show a scale bar, a colour bar with units, and the redshift or the time",
     "",
     [](Viewer& v, const Words& w) { state_of(v).look.annotated = switch_of(w[0]); },
     {.is_for_scripts = true}},
    {"title",
     "TEXT|off",
     "Particles",
     "Show the scale and colour bars with a title",
     "",
     set_title,
     {.is_for_scripts = true}},
    {"annotation-depth",
     "MM",
     "Particles",
     "How far behind the screen the bars and the title stand, in mm; before it where negative",
     "",
     set_annotation_depth,
     {.is_for_scripts = true}},
    {"annotations",
     "",
     "Particles",
     "Scale and colour bars",
     "B",
     [](Viewer& v, const Words&) { state_of(v).look.annotated = !state_of(v).look.annotated; },
     {.now = [](const Viewer& v) { return on_or_off(v.session().state.look.annotated); }, .begins_group = true}},
    {"focus", "X,Y|off", "Depth", "Point with more depth than elsewhere, as shares of a view of particles or slices",
     "", set_focus},
    {"focus-at", "X Y", "Depth", "More depth around a place on the screen", "", focus_at},
    {"focus-radius",
     "SHARE",
     "Depth",
     "Radius of the focus: of the area with more depth, as a share of the width",
     "",
     [](Viewer& v, const Words& w) { set_focus_number(v, &ScreenFocus::radius, number_of(w[0], 0.001, 10)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.look.focus.radius); },
      .range = {0.05, 1, 0.05},
      .applies = shows_focus}},
    {"focus-gain",
     "FACTOR",
     "Depth",
     "Depth at the focus: factor on it",
     "",
     [](Viewer& v, const Words& w) { set_focus_number(v, &ScreenFocus::gain, number_of(w[0], 0, 10)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.look.focus.gain); },
      .range = {0, 4, 0.1},
      .applies = shows_focus}},
};

}  // namespace

std::span<const Command> particle_commands() { return particle_table; }

std::span<const Command> quantity_commands() { return quantity_table; }

}  // namespace wheatstone::viewer
