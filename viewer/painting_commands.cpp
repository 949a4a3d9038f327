#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "command_groups_internal.h"
#include "undo.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/style_parameters.h"

namespace wheatstone::viewer {
namespace {

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
  if (style == state_of(viewer).style) return;
  state_of(viewer).style = style;
  viewer.paint();
}

void compare(Viewer& viewer, const Words& words) {
  const auto found = std::ranges::find(comparison_names, words[0]);
  if (found == comparison_names.end())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("'{}' is nothing to compare, expected painting, photograph or split", words[0]));
  state_of(viewer).comparison = static_cast<Comparison>(found - comparison_names.begin());
}

constexpr Command painting_table[] = {
    // name, arguments, menu, text, keys
    {"finest-layer", "NUMBER", "Painting", "Finest layer of strokes that is shown, from 0, the coarsest", "",
     [](Viewer& v, const Words& w) { state_of(v).finest_layer = static_cast<int>(number_of(w[0], 0, 1000)); }},
    {"less-detail", "", "Painting", "Less detail", "[", [](Viewer& v, const Words&) { step_detail(v, -1); }},
    {"more-detail", "", "Painting", "More detail", "]", [](Viewer& v, const Words&) { step_detail(v, 1); }},
    {"style", "NAME|FILE", "Painting", "Style", "", set_style},
    {"set", "PARAMETER VALUE", "Painting", "Change a parameter of the style", "", set_parameter},
    {"compare", "painting|photograph|split", "Painting", "Compare with the photograph", "", compare},
    {"undo", "", "Painting", "Undo", "Ctrl+Z", [](Viewer& v, const Words&) { undo(v); }},
    {"redo", "", "Painting", "Redo", "Ctrl+Shift+Z", [](Viewer& v, const Words&) { redo(v); }},
};

}  // namespace

std::span<const Command> painting_commands() { return painting_table; }

}  // namespace wheatstone::viewer
