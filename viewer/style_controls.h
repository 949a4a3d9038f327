#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::viewer {

/// What the user moves: a number between two ends, in steps.
struct NumberControl {
  double least = 0, most = 1, step = 0.05;
};
struct SwitchControl {};
struct ChoiceControl {
  std::span<const std::string_view> names;
};
/// Anything else, as it is typed.
struct TextControl {};

/// How a parameter of a style is set in a panel.
struct StyleControl {
  const StyleParameter* parameter = nullptr;
  std::variant<NumberControl, SwitchControl, ChoiceControl, TextControl> kind;
};

/// One for every parameter, in their order.
std::span<const StyleControl> style_controls();

/// A parameter's value as its `set` takes it: "8,4,2", "true", "median".
std::string plain_value(const StyleParameter& parameter, const Style& style);

}  // namespace wheatstone::viewer
