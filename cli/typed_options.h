#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "number_arguments.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {

// Options with a type, which share one form of help and of error: a number is finite and in its range, a choice is one
// of its names. `value` keeps its default, which the help shows, until the line is parsed; it must live as long as the
// command.

/// The first of an option's names: "--output" of "-o,--output".
std::string option_name(const std::string& names);

namespace typed {

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {
  using Value = T;
};

/// Adds the option with its type's name and its default.
template <class Value, class Parse>
CLI::Option* add(CLI::App& command, const std::string& names, Value& value, const std::string& help, Parse parse) {
  return command.add_option_function<std::string>(
      names, [&value, parse](const std::string& text) { value = parse(text); }, help);
}

}  // namespace typed

/// A whole or a real number, or an optional of either, as `value` is.
template <class Value>
CLI::Option* add_number(CLI::App& command, const std::string& names, Value& value, NumberRange range,
                        const std::string& help) {
  CLI::Option* option = nullptr;
  if constexpr (typed::IsOptional<Value>::value) {
    using Number = typename typed::IsOptional<Value>::Value;
    option = typed::add(command, names, value, help, [name = option_name(names), range](const std::string& text) {
      if constexpr (std::is_integral_v<Number>) return static_cast<Number>(parse_integer(name, text, range));
      return static_cast<Number>(parse_number(name, text, range));
    });
  } else {
    option = typed::add(command, names, value, help, [name = option_name(names), range](const std::string& text) {
      if constexpr (std::is_integral_v<Value>) return static_cast<Value>(parse_integer(name, text, range));
      return static_cast<Value>(parse_number(name, text, range));
    });
    // NaN stands for "not given".
    if (value == value) option->default_str(fmt::format("{}", value));
  }
  return option->type_name("NUMBER");
}

/// A length in millimetres, or with a unit: mm, cm, m, in.
template <class Value>
CLI::Option* add_length(CLI::App& command, const std::string& names, Value& value_mm, NumberRange range_mm,
                        const std::string& help) {
  return typed::add(command, names, value_mm, help,
                    [name = option_name(names), range_mm](const std::string& text) {
                      return static_cast<Value>(parse_length_mm(name, text, range_mm));
                    })
      ->default_str(fmt::format("{}", value_mm))
      ->type_name("LENGTH");
}

/// A value by its name; the help lists the names. `choices` must live as long as the command.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& names, Value& value,
                        std::span<const std::pair<std::string_view, Value>> choices, const std::string& help) {
  std::string all, present;
  for (const auto& [name, choice] : choices) {
    all += fmt::format("{}{}", all.empty() ? "" : "|", name);
    if (choice == value) present = name;
  }
  return typed::add(command, names, value, help,
                    [option = option_name(names), choices, all](const std::string& text) {
                      for (const auto& [name, choice] : choices)
                        if (name == text) return choice;
                      throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", option, text, all));
                    })
      ->default_str(present)
      ->type_name(all);
}

/// The same for a choice that stays a name.
CLI::Option* add_name(CLI::App& command, const std::string& names, std::string& value,
                      std::span<const std::string_view> choices, const std::string& help);

}  // namespace wheatstone::cli
