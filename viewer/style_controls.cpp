#include "style_controls.h"

#include <algorithm>
#include <array>

namespace wheatstone::viewer {
namespace {

constexpr std::array<std::string_view, 5> marks{"strokes", "fitted-strokes", "regions", "tiles", "curves"};
constexpr std::array<std::string_view, 3> propagations{"strokes", "raster", "independent"};
constexpr std::array<std::string_view, 2> orientations{"smooth", "gradient"};
constexpr std::array<std::string_view, 2> filters{"median", "gaussian"};
constexpr std::array<std::string_view, 2> backgrounds{"photograph", "colour"};

struct NamedChoice {
  std::string_view parameter;
  std::span<const std::string_view> names;
};
constexpr std::array<NamedChoice, 5> choices{{{"marks", marks},
                                              {"propagation", propagations},
                                              {"orientation", orientations},
                                              {"reference-filter", filters},
                                              {"background", backgrounds}}};

/// The ends within which a parameter changes what is seen; `set` takes more. Those of a share need no line.
struct NamedRange {
  std::string_view parameter;
  NumberControl range;
};
constexpr std::array<NamedRange, 14> ranges{{{"threshold", {0, 441, 5}},
                                             {"strokes", {0, 100000, 500}},
                                             {"bristle", {0, 8, 0.25}},
                                             {"streaks", {0, 64, 1}},
                                             {"ridge", {0, 64, 1}},
                                             {"grid", {0.25, 4, 0.25}},
                                             {"blur", {0, 4, 0.25}},
                                             {"min-length", {0, 32, 1}},
                                             {"max-length", {0, 64, 1}},
                                             {"colours", {2, 64, 1}},
                                             {"tile", {4, 64, 1}},
                                             {"depth-threshold", {0.25, 20, 0.25}},
                                             {"occlusion-dilation", {0, 2, 0.125}},
                                             {"opacity", {0.05, 1, 0.05}}}};

bool is_number(std::string_view value) {
  return !value.empty() && value.find_first_not_of("0123456789.-+e") == std::string_view::npos;
}

std::span<const std::string_view> brushes() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all{"none"};
    all.insert(all.end(), brush_names().begin(), brush_names().end());
    return all;
  }();
  return names;
}

StyleControl control_of(const StyleParameter& parameter) {
  if (parameter.is_switch) return {&parameter, SwitchControl()};
  if (parameter.name == "brush") return {&parameter, ChoiceControl{brushes()}};
  for (const NamedChoice& choice : choices)
    if (choice.parameter == parameter.name) return {&parameter, ChoiceControl{choice.names}};
  for (const NamedRange& range : ranges)
    if (range.parameter == parameter.name) return {&parameter, range.range};
  if (is_number(parameter.toml_value(Style()))) return {&parameter, NumberControl()};
  return {&parameter, TextControl()};
}

std::vector<StyleControl> make_controls() {
  std::vector<StyleControl> controls;
  for (const StyleParameter& parameter : style_parameters()) controls.push_back(control_of(parameter));
  return controls;
}

}  // namespace

std::span<const StyleControl> style_controls() {
  static const std::vector<StyleControl> controls = make_controls();
  return controls;
}

std::string plain_value(const StyleParameter& parameter, const Style& style) {
  std::string value = parameter.toml_value(style);
  std::erase_if(value, [](char letter) { return letter == '[' || letter == ']' || letter == '"' || letter == ' '; });
  return value;
}

}  // namespace wheatstone::viewer
